"""What was measured: runs, datasets, and what can be read from them without a model.

Reading a dataset:

- `run`: one measured run; `dataset`: all of them, and how they are read
- `source`: where a dataset and its files are; `description`: what its file says as a whole
- `declaration`, `channel`, `inherit`: what it says about a run, and what the defaults say in its place
- `table`: what a reader of measurement files hands over; `columns`: from its columns to SI
- `measured`: from a declaration and a table to a run; `clock`, `resample`: even sampling, delays, decimation
- `disturbance`: drift and hum; `correction`, `run_entries`: faults of single runs, written into a dataset file
- `checks`, `clipping`, `trouble`: what makes a run unusable; `groups`: repeats; `digest`: a fingerprint

Reading from runs:

- `drive`: the motion that drives a model
- `noise`, `white_noise`, `noise_spectrum`: the noise floor
- `reversals`, `phase`, `orders`, `order_tracking`, `backbone`: loops, sweeps and their orders
"""
