# %% [markdown]
# # Find a hidden effect
#
# A mount was measured, and a spring with a damper does not describe it. Which effect is missing?
#
# ## A specimen with a hidden effect
#
# To check the result, the mount is a model with a hidden effect; a virtual rig measures it with noise, each sweep
# twice.

# %%
from pathlib import Path

import dashpot as dp

secret = dp.declare("""
format: dashpot-network/1
name: secret
branches:
  rubber: {element: spring, stiffness: 200 N/mm}
  damping: {element: damper, damping: 0.4 N*s/mm}
  hidden: {element: maxwell, stiffness: 60 N/mm, relaxation_time: 20 ms}
""")
Path("bench.yaml").write_text("""
format: dashpot-rig/1
name: small bench
tests:
  - rig: hydropulser
    amplitudes: [0.5 mm, 1 mm]
    preloads: [2 mm, 4 mm]
    direction: up
    duration: 3 s
    sampling: 500 Hz
measuring: {force_noise: 4 N, repeats: 2}
""")
data = dp.measure(secret, "bench.yaml", seed=3)
data

# %% [markdown]
# ## The model

# %%
simple = dp.declare("""
format: dashpot-network/1
name: simple
branches:
  rubber: {element: spring, stiffness: {start: 150 N/mm}}
  damping: {element: damper, damping: {start: 0.5 N*s/mm}}
""")
fit = dp.fit(simple, data)
fit.plot("stiffness")

# %% [markdown]
# The points are the measurement, the lines the fit: stiffness and loss angle deviate. The table has the RMSE
# next to the noise floor.

# %%
fit

# %% [markdown]
# ## Diagnosis

# %%
diagnosis = dp.diagnose(simple, data)
diagnosis

# %% [markdown]
# The cause was named, and the file was extended by a branch with parameters and their intervals: compare them with the
# hidden effect. The gain is measured on held-out runs.

# %%
diagnosis.plot("stiffness")

# %% [markdown]
# ## The extended model
#
# It is a model like any other: simulate it, fit it to other data, save it.

# %%
diagnosis.extended
