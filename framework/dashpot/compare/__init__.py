"""Models beside the data, without a cause in mind: how much of the error any model could explain, and its shape.

motion       what a general model remembers of the motion of a run
features     functions of these memories and of the conditions of a run
ridge        linear regression, its strengths found by leaving runs out in turn
boosting     trees on what the regression leaves
explainable  the error that a general model leaves on runs it did not see
strokes      a run cut at its reversals, and the work of its cycles
shapes       the force at mid stroke, at low speed, after reversals and by condition
residual_map the two variables that explain a residual best
look         what there is to see of runs before any model
"""
