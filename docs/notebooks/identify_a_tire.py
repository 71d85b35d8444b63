# %% [markdown]
# # Identify a tire
#
# A tire was pressed slowly, then shaken from 1 to 25 Hz. Which parameters does a model of it have, with which
# intervals, and how many elements does it need?

# %% [markdown]
# ## The measurement
#
# `test_tire` is a program that stands for a tire on a rig: it shares no law with the models below. It writes a dataset
# as a rig does. With files of your own, begin at `load_dataset`.

# %%
from pathlib import Path

import dashpot as dp

tire = dp.load_registry().specimens["test_tire"]()
path = tire.measure(Path("tire"), seed=1)
everything = dp.load_dataset(path)
everything

# %% [markdown]
# The slow loop and some of the sweeps are enough for a first look; two of them were measured twice.

# %%
data = everything.select(["qs", "a05_p17", "a05_p17_b", "a2_p17", "a2_p17_b", "a5_p10"])
data.plot("stiffness")

# %% [markdown]
# Around 17 mm the tire is stiffer when it is shaken less: that is friction. It is stiffer at higher frequencies:
# that is relaxation.
#
# ## One model
#
# `gehmann` is a spring and one Maxwell branch. Its spring comes `from: quasi_static`, from the slow loop.

# %%
fit = dp.fit("gehmann", data, seed=1)
fit

# %% [markdown]
# `95 % from ... to` is the confidence interval of the parameter, given the structure. The plot shows whether that is
# right:
# lines are the model, points the measurement.

# %%
fit.plot("stiffness")

# %% [markdown]
# No amplitude changes the stiffness of this model, since it is linear around a preload.
#
# ## Several models
#
# The figure of merit is the RMSE on held-out runs; its lower bound is the noise floor.

# %%
comparison = dp.compare(["kelvin_voigt", "gehmann", "tire_model_1"], data, seed=1)
comparison

# %%
comparison.plot()

# %% [markdown]
# ## Keep it
#
# The identified model is the same file with the identified parameters.

# %%
best = min(comparison.fits, key=lambda fit: fit.errors.held_out or fit.errors.train)
print(best.model.text[-900:])
