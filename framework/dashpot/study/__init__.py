"""What a fitted study tells: masses, the errors of its models, and the curves of an axle.

masses      the masses that a study answers for
axle        what the runs of an axle tell beside a fit
axle_study  the same for all models of a study
sensitivity how metrics of a test depend on parameters, and how they scatter
study       the content of a study's result files
"""
