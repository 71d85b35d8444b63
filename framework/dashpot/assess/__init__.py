"""Judging models: comparison of several on one dataset, and the diagnosis of what one gets wrong.

noise     - the colour of the measurement noise, and whitening by it
view      - what a suspected cause may look at
screen    - every suspect against the residual, without a refit
contest   - the finalists, refitted
verdict   - what is said in the end
"""
