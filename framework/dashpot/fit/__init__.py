"""Finding parameters: the objective, the driver of the optimizers, fits in stages.

search    run any optimizer to its end, its budget or its target
replay    answers to asked blocks, from a record first
chain     several optimizers, each from the best point of the one before
"""
