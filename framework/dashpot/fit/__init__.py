"""Finding parameters: what they are worth, and the search for the best.

api          the stages of an identification, called in order
holdout      which runs a fit may see
scored       a run with its drive, its measured force and the samples that count
floor        the noise floor of a dataset
grounding    curves taken out of the data
ranges       where to search a parameter whose file gives no bounds
coordinates  the searched parameters as logarithms and plain numbers, and as the unit cube
objective    what a block of parameter vectors is worth on a set of runs
search       run any optimizer to its end, its budget or its target
replay       answers to asked blocks: from a record first, then by evaluation
starts       the framework's own search: a screening block, then refinements of the best of it
refine       damped Gauss-Newton, the framework's own refinement
uncertainty  how well the parameters are known
prior        what was known before, as residual terms
posterior    draws from the posterior of a fit
chains       whether these draws have come to rest
decided      which directions a Jacobian decides, and which its own error only seems to
identifiability  what the data can tell, from the Fisher information, in words
spare        branches without which the data are explained as well
profile      the profile likelihood of a number
bootstrap    refits on runs drawn with replacement
virtual_test a network on a test bench
study        a staged identification that stands in a file
algebra      linear algebra on one thread
result       what an identification found
"""
