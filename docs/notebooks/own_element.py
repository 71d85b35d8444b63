# %% [markdown]
# # An element of your own
#
# A law is a class with one method, in numpy. The framework derives the compiled code and the tangents from it, and
# checks what the class declares.

# %%
import numpy as np

import dashpot as dp


class HardeningSpring(dp.Element):
    """A spring that hardens: F = k x (1 + (x/w)^2)."""

    word = "hardening_spring"
    stiffness = dp.Parameter("N/m", "stiffness at no deflection", bounds=(1.0, 1e9), symbol="k")
    width = dp.Parameter("m", "deflection at which it is twice as stiff", bounds=(1e-2, 1.0), symbol="w")

    def step(self, x, z, p, dt):
        return dp.Response(p.stiffness * x.new * (1.0 + (x.new / p.width) ** 2))


# %% [markdown]
# ## Checked
#
# Declarations and units, that eager, traced and compiled law agree, the derived tangent, that NaN stays visible:

# %%
from dashpot.testing import check_element

check_element(HardeningSpring)

# %% [markdown]
# ## In a network
#
# A plugin would bring it in for every command ([how to](../../how-to/own-plugin.md)); in a notebook a registry with it
# is enough.

# %%
from dataclasses import replace

installed = dp.load_registry()
registry = replace(installed, elements={**installed.elements, "hardening_spring": HardeningSpring})
bump = dp.declare(
    """
format: dashpot-network/1
name: bump_stop
branches:
  rubber: {element: hardening_spring, stiffness: {start: 20 N/mm}, width: {start: 30 mm}}
  friction: {element: dahl, stiffness: {start: 100 N/mm}, limit: {start: 10 N}}
""",
    registry=registry,
)
bump

# %% [markdown]
# ## Fitted
#
# To a slow press that a formula measures, with 5 N of noise:

# %%
time = np.linspace(0.0, 20.0, 2001)
x = 25e-3 * (1.0 - np.cos(2.0 * np.pi * time / 20.0)) / 2.0
friction = np.where(time < 10.0, 25.0 * (1.0 - np.exp(-x / 0.2e-3)), 25.0 * (2.0 * np.exp((x - 25e-3) / 0.2e-3) - 1.0))
force = 30e3 * x * (1.0 + (x / 20e-3) ** 2) + friction + 5.0 * np.random.default_rng(1).normal(size=x.size)
data = dp.Data.from_arrays(time, x, force, name="press")
fit = dp.fit(bump, data, registry=registry)
fit.table()

# %%
fit.plot("loops")
