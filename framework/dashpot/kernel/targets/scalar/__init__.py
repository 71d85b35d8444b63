"""Code for one lane in languages with variables, loops and functions; what a language is, its own folder says.

code      - how statements are written
graph     - a graph becomes expressions
functions - what mathematics libraries do not have
prepare   - what is made of the parameters before the first step
online    - a network with two ends, sample by sample
coupled   - the same for a network with unknown nodes
whole     - whichever of the two a network needs
"""
