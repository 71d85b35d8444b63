"""Judging models: comparison of several on one dataset, and the diagnosis of what one gets wrong.

compare    several networks, one table
diagnose   the diagnosis, its steps called in order
diagnosis  what it found, and how it is written down
triage     faults of the measurement, before the model is blamed
noise      the colour of the measurement noise, and whitening by it
view       what a suspected cause may look at
screen     every suspect against the residual, without a refit
suspicion  one look at a fitted model: noise learned, refit, screen
mend       faults of the force channel taken out of the measured force
contest    extended networks, refitted
unseen     faults of single held-out runs
pursuit    causes accepted one after the other, and pruned
gain       what an extension gains on runs it never saw
leftover   is there structure that no suspect explains
named      the accepted causes as they are told
tracking   the oscillation of a run, followed once
conditions amplitude, preload and frequency that a run was made at
bands      bands of frequency with round edges
misfit     what the model gets wrong, in words
verdict    what is said in the end
signals    measured and simulated signals for the report
evidence   everything else that the report shows
"""
