"""Networks as C99 for programs without Python: no allocation, no library but that of mathematics.

code   - statements of C
header - what a program includes
source - the functions behind it
watch  - whether the motion leaves the range of identification
"""
