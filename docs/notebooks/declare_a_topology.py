# %% [markdown]
# # Declare a topology
#
# A model is a text. Here one grows from a spring to a mount on a moving platform.

# %%
import dashpot as dp

mount = dp.declare("""
format: dashpot-network/1
name: mount
about: A rubber mount.
branches:
  rubber:
    element: spring
    stiffness: {start: 220 N/mm, bounds: [20 N/mm, 2 kN/mm]}
  relaxation:
    element: maxwell
    stiffness: {start: 60 N/mm, bounds: [1 N/mm, 1 kN/mm]}
    relaxation_time: {start: 160 ms, bounds: [1 ms, 10 s]}
""")
mount

# %% [markdown]
# The branches act in parallel: each sees the whole deflection, and the forces add up. `≈` marks a parameter to
# be identified.
#
# ## Mistakes are reported with their place
#
# All of them at once, each with what to do.

# %%
from dashpot import InputError

try:
    dp.declare("""
format: dashpot-network/1
name: wrong
branches:
  rubber: {element: sprng, stiffness: 220 N/mm}
  relaxation: {element: maxwell, stiffness: 60 N/mm, relaxation_time: 160 N}
""")
except InputError as error:
    print(error)

# %% [markdown]
# So are weaknesses of a structure, before there are any data:

# %%
twins = dp.declare("""
format: dashpot-network/1
name: twins
branches:
  rubber: {element: spring, stiffness: 220 N/mm}
  first: {element: damper, damping: {start: 0.5 N*s/mm}}
  second: {element: damper, damping: {start: 0.3 N*s/mm}}
""")
twins.weaknesses()

# %% [markdown]
# ## Nodes
#
# Masses and parts in series need nodes: here a mount carries 40 kg, and the platform below it moves.

# %%
carried = dp.declare("""
format: dashpot-network/1
name: carried_mass
gravity: 9.81 m/s^2
nodes:
  platform: driven
  engine: {mass: 40 kg}
  body: ground
branches:
  mount:
    between: [platform, engine]
    series:
      rubber:
        parallel:
          spring: {element: spring, stiffness: 220 N/mm}
          loss: {element: damper, damping: 0.3 N*s/mm}
      bracket: {element: spring, stiffness: 2 kN/mm}
  stay: {element: spring, stiffness: 15 N/mm, between: [engine, body]}
""")
carried

# %% [markdown]
# ## Try it
#
# A model with known parameters can be measured on a virtual rig, here along a slow triangle; the result is a dataset
# like any other.

# %%
known = dp.declare("""
format: dashpot-network/1
name: rubber_with_friction
branches:
  rubber: {element: spring, stiffness: 220 N/mm}
  friction: {element: dahl, stiffness: 400 N/mm, limit: 60 N}
""")
loop = dp.measure(known, "triangle", depth="3 mm", loops=1)
loop.plot("loops")

# %% [markdown]
# The loop is as wide as twice the sliding force, 120 N: friction does not depend on the speed.

# %%
import numpy as np

force, depth = loop.runs[0].force, loop.runs[0].displacement
turn = depth.argmax()
pressed = np.interp(1.5e-3, depth[:turn], force[:turn])
released = np.interp(1.5e-3, depth[:turn:-1], force[:turn:-1])
print(f"width at 1.5 mm: {pressed - released:.0f} N")
