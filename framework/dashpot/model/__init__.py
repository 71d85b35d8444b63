"""What is declared: elements and their parameters, networks of branches, and the YAML text they are written in.

element  - what an element declares, and the method in which it says its law
path     - the memory that relaxing elements have of a cubic path
network  - a network as plain data
reading  - from a text to a network: branches, curves and values, and what clashes between them
shipped  - where the shipped networks lie
patch    - editing the text of a network
"""
