# %% [markdown]
# # Arrays, networks as objects, scikit-learn
#
# Samples in memory become a dataset, a network is built line by line, and models are compared by the tools of
# scikit-learn. No file is written before the last cell.

# %% [markdown]
# ## Samples in memory
#
# A rubber bush under sines of four frequencies, each measured twice; here a formula stands for the rig. Time in s,
# displacement in m and force in N, or as `units` says. Without `kind` it is found from the motion.

# %%
import numpy as np

import dashpot as dp

rng = np.random.default_rng(4)
time = np.arange(0.0, 2.0, 1e-3)
parts = []
for frequency in (1.0, 4.0, 9.0, 16.0):
    for repeats in (None, f"f{frequency:g}"):
        turning = 2.0 * np.pi * frequency
        stiffness = 200.0 + 60.0 * 0.02j * turning / (1.0 + 0.02j * turning)  # N/mm
        force = (stiffness * np.exp(1j * turning * time)).imag + 2.0 * rng.normal(size=time.size)
        parts.append(
            dp.Data.from_arrays(
                time,
                np.sin(turning * time),
                force,
                units={"displacement": "mm"},
                name=f"f{frequency:g}" + ("_again" if repeats else ""),
                repeats=repeats,
                settings={"amplitude": "1 mm", "frequency": frequency},
            )
        )
data = dp.Data.join(parts, "bush")
data

# %% [markdown]
# `from_pandas` and `from_xarray` do the same with frames; `data.dynamic_stiffness()` has K', K'' and the loss angle of
# each run as arrays.

# %%
{
    name: f"{np.mean(found.magnitude) / 1e3:.1f} N/mm, {np.degrees(np.mean(found.loss_angle)):.2f} deg"
    for name, found in data.dynamic_stiffness().items()
}

# %% [markdown]
# ## A network as an object
#
# What is set is what a file would say: a text with its unit, a number in SI, or a start with bounds.

# %%
voigt = dp.Network("voigt")
voigt.add("rubber", "spring", stiffness={"start": "150 N/mm"})
voigt.add("loss", "damper", damping={"start": "0.5 N*s/mm"})
zener = dp.declare(voigt.text.replace("name: voigt", "name: zener"))
del zener["loss"]
zener.add("relaxation", "maxwell", stiffness={"start": "50 N/mm"}, relaxation_time={"start": "10 ms"})
print(zener.text)

# %% [markdown]
# ## A fit, and what it says

# %%
fit = dp.fit(zener, data)
print(fit.summary())
print("standard errors", dict(zip(fit.free, np.sqrt(np.diag(fit.covariance)).round(6).tolist(), strict=True)))
print("rms residual of f9 after its first cycle:", fit.residuals["f9"][111:].std().round(2), "N")
print("AIC", round(fit.aic), "BIC", round(fit.bic))

# %% [markdown]
# The complex stiffness of the model beside the formula, at frequencies that were not measured:

# %%
frequency = np.array([2.0, 6.0, 12.0])
turning = 2.0 * np.pi * frequency
truth = 1e3 * (200.0 + 60.0 * 0.02j * turning / (1.0 + 0.02j * turning))
found = fit.model.dynamic_stiffness(frequency, amplitude=1e-3)
print("deviation in percent:", (100.0 * abs(found / truth - 1.0)).round(3))

# %% [markdown]
# ## Cross-validation
#
# A sample is a whole run. `data.groups` keeps a run and its repeat on the same side of each fold.

# %%
from sklearn.model_selection import GridSearchCV, GroupKFold

search = GridSearchCV(dp.Estimator(voigt), {"model": [voigt, zener]}, cv=GroupKFold(4))
search.fit(data.runs, groups=data.groups)
for model, score in zip(search.cv_results_["param_model"], search.cv_results_["mean_test_score"], strict=True):
    print(f"{model.name}: 1 - R^2 = {1.0 - score:.6f}")

# %% [markdown]
# ## Keep it

# %%
print(search.best_estimator_.fit_.save("bush.yaml").read_text()[:300])
