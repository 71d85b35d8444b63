"""A staged identification that stands in a file.

declaration  what a study file says
reading      from its text to the declaration, all mistakes at once
patterns     names of runs and numbers with `*` and `?`
carry        numbers taken over from a model that was identified before
checkpoint   what was done so far, on disk
stage        one search of one model
run          all stages of all models, in order
"""
