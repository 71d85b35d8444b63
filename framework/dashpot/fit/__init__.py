"""Finding parameters: what they are worth, and the search for the best.

scored       a run with its drive, its measured force and the samples that count
objective    what a block of parameter vectors is worth on a set of runs
coordinates  the searched parameters as logarithms and plain numbers, and as the unit cube
search       run any optimizer to its end, its budget or its target
replay       answers to asked blocks: from a record first, then by evaluation
chain        several optimizers, each from the best point of the one before
refine       damped Gauss-Newton, the framework's own polish
"""
