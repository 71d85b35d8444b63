"""What a network has become when all that does not depend on a language is decided.

program - the program of a network with two ends: what is hoisted, and what a step computes
system  - the program of a network with unknown nodes: its passes and the loop of a step around them
layout  - where a pass finds what: rows of the workspace, columns of the drive, tables
stages  - the order of a pass
online  - the program that somebody else steps, one sample at a time
"""
