"""Triage: faults of the measurement, looked for before anything is fitted and before the model is blamed.

fault       what is said of a run, and the run as it goes on
duplicates  one record under two names
one_test    runs that are one test, though nobody says so
dropouts    samples that were lost
work        the work that a specimen takes up over closed cycles
scatter     the scatter of a run where few cycles tell it
energy      which runs give work back beyond doubt
passivity   what these most likely are
forecast    what the other runs predict for the force of a run, without a model
agreement   the runs of a dataset that agree, and those that do not
conditions  by how much conditions change a force
scale       wrong polarity, wrong unit
actuator    harmonics of the motion itself
examine     all of it in order
"""
