"""The scalar graph of a law: traced from numpy code, interpreted, derived and printed. Imports nothing of ours."""
