"""Many specimens, the same models: every one by itself, and what they are as a population.

declaration reading specimens address schema   what a campaign file says, and where its data are
job run preview scheduler                      one piece of work, all of them, what they would cost, who does them
numbers mixed unlike named                     the specimens as a population, and those that do not belong to it
charts alike sharing causes                    batches, groups, numbers in common, causes found
content                                        the content of the result files
"""
