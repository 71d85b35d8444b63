"""What is declared: elements and their parameters, networks of branches, and the YAML text they are written in."""
