"""The scalar graph of a law. Imports nothing of ours.

node      - what a graph is made of, and how numpy calls become nodes
derive    - tangents, as graphs again
rebuild   - the same graph with some nodes replaced
interpret - running a graph in plain numpy
written   - graphs as text, to be kept in files
"""
