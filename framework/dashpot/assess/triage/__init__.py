"""Triage: faults of the measurement, looked for before the model is blamed.

fault       what is said of a run
likeness    which run is unlike all others, and by what factor
scale       wrong polarity, wrong unit
duplicates  one record under two names
dropouts    samples that were lost
actuator    harmonics of the motion itself
examine     all of it in order
"""
