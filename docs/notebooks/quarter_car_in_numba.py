# %% [markdown]
# # A quarter car with an identified tire
#
# A network becomes a function that numba compiles: your own loop over time calls it as it calls any other function,
# and no Python runs in between.

# %% [markdown]
# ## A tire from measurements
#
# Five elements in parallel, identified from a slow loop and a few sweeps of a virtual tire.

# %%
from pathlib import Path

import dashpot as dp

path = dp.load_registry().specimens["test_tire"]().measure(Path("tire"), seed=1)
data = dp.load_dataset(path).select(["qs", "a05_p17", "a2_p17", "a5_p10"])
fit = dp.fit("tire_model_5", data, seed=1)
tire = fit.model
fit

# %%
fit.plot("stiffness")

# %% [markdown]
# ## Its solver
#
# `step(state, x, v, dt, parameters)` takes the tire to a deflection `x` and its rate `v` and returns the force. All
# states are in the array `state`; the parameters of the model are in the array `parameters`, in the order of `names`.

# %%
solver = tire.jit()
dict(zip(solver.names[-4:], solver.parameters[-4:], strict=True))

# %% [markdown]
# ## The car
#
# A wheel on the tire, a quarter of the body on a spring and a damper; the road is a bump of 30 mm. The loop is compiled
# with the tire in it, and goes on in small steps.

# %%
import numpy as np
from numba import njit

step = solver.step
WHEEL, BODY, SPRING, DAMPING, GRAVITY = 40.0, 350.0, 25e3, 1500.0, 9.81


@njit(nogil=True)
def ride(speed, dt, samples, parameters, state, out):
    load = (WHEEL + BODY) * GRAVITY
    wheel = body = wheel_speed = body_speed = 0.0
    sunk = 0.0
    for _ in range(60):  # how far the tire gives under the car: a slow press until it carries the load
        sunk += (load - step(state, sunk, 0.0, 1.0, parameters)) / 4e5
    for k in range(samples):
        way = speed * k * dt - 1.0
        road = 15e-3 * (1.0 - np.cos(2.0 * np.pi * way)) if 0.0 < way < 1.0 else 0.0
        road_speed = 15e-3 * 2.0 * np.pi * speed * np.sin(2.0 * np.pi * way) if 0.0 < way < 1.0 else 0.0
        tire_force = step(state, sunk + road - wheel, road_speed - wheel_speed, dt, parameters)
        strut = SPRING * (wheel - body) + DAMPING * (wheel_speed - body_speed)
        wheel_speed += dt * (tire_force - load - strut) / WHEEL
        body_speed += dt * strut / BODY
        wheel += dt * wheel_speed
        body += dt * body_speed
        out[k, 0], out[k, 1], out[k, 2] = road, wheel, body
    return tire_force


motion = np.empty((15_000, 3))
force = ride(10.0, 1e-4, len(motion), solver.parameters, solver.state(), motion)
print(
    f"highest point of the road {motion[:, 0].max() * 1e3:.1f} mm, of the wheel {motion[:, 1].max() * 1e3:.1f} mm, "
    f"of the body {motion[:, 2].max() * 1e3:.1f} mm; tire force at the end {force:.0f} N"
)

# %% [markdown]
# ## Inside an optimizer
#
# Nothing but numpy arrays goes in and out, so that everything that calls functions can use the solver: here
# `scipy.optimize` looks for the stiffness of the spring of the tire with which the wheel rises least.

# %%
from scipy.optimize import minimize_scalar

first = solver.names.index("stiffness.stiffness[0]")
knots = [k for k, name in enumerate(solver.names) if name.startswith("stiffness.stiffness[")]


def highest(share):
    parameters = solver.parameters.copy()
    parameters[knots] *= share
    ride(10.0, 1e-4, len(motion), parameters, solver.state(), motion)
    return motion[:, 1].max()


best = minimize_scalar(highest, bounds=(0.7, 1.3), method="bounded", options={"maxiter": 15})
print(f"with {best.x:.2f} of the stiffness the wheel rises {best.fun * 1e3:.1f} mm")
