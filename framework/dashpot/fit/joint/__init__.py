"""Several specimens identified together, with parameters that are one number for all of them.

declaration - what a joint file says
reading     - reading it
tied        - the coordinates of all specimens, shared ones once
objective   - the misfit of all specimens
run         - each specimen alone, then all together
"""
