"""Languages that programs are printed in. Each folder or file knows one language, and none knows another.

choice  - the targets that run in this process, and which of them does
cache   - where compiled code is kept
llvm    - vectors of lanes as LLVM assembly: the fastest, and the default
"""
