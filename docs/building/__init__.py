"""How the documentation is made: pages from the registry, equations from the docstrings, notebooks run."""
