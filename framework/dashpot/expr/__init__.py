"""The scalar graph of a law. Imports nothing of ours.

node      - what a graph is made of, and how numpy calls become nodes
derive    - tangents, as graphs again
interpret - running a graph in plain numpy
"""
