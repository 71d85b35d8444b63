"""Languages that programs are printed in. Each folder or file knows one language, and none knows another.

choice   - the targets that run in this process, and which of them does
omega    - the coefficients of a long function
llvm     - vectors of lanes as LLVM assembly: the fastest, and the default
scalar   - one lane, statement by statement, in any language with variables and loops; the next three are such
numba    - functions that numba compiles
c99      - a header and a source
modelica - a package of functions and a model
"""
