"""Networks as functions that numba compiles, to be called from anybody's compiled code.

code     - statements of Python as numba compiles it
module   - modules, kept by what they are made of
stepping - step and simulate
"""
