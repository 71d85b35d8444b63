"""How the metrics of a test depend on the parameters of a network, and how they scatter where these do.

declaration - what a sensitivity study says
reading     - reading it
schema      - its JSON schema
run         - simulating it, many parameter vectors at a time
content     - the result in plain values
"""
