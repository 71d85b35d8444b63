"""The diagnosis: which causes predict what a fitted network misses, how sure that is, and the files that say so.

view          a fitted network as suspected causes see it
location      where suspects are looked for
inside        the inside of a network with nodes
candidate     a form of a cause as columns of a matrix
whitening     the noise of each run, and signals in units of it
table_rows    rows of tables: two values each, curves of them left out
plainest      what tables alone cannot show
term          a network with the terms that were added to it
refit         fitting a structure to whitened misfits
bends         what a table may do between its knots
folds         what is left out at a time
look          residual, terms and candidates as Gram matrices by group of runs
score         what a structure predicts of runs left out, and its prior odds
search        beam search over structures
evidence      what has to show a fault of the measurement in all runs
pursuit       the best structure, those beside it, and how sure its causes are
trials        structures refitted, and what they predict
pursue        look, search and refit until no structure scores better
spare         branches of the diagnosed network that may go
repeats       what repeats of a run tell of faults of its force channel
faults_beside faults of single runs beside a linearised model
channel       faults of the force channel in single runs
polish        the parameters of the final files and their intervals
lines         lines in spectra
leftover      structure that no cause explains
limits        the detection limits, the smallest effects found with 95 % power
proposals     runs to choose the next measurement from
next_run      the run that tells two models apart
gain          what a cause is worth on runs that took no part
named         what was added to the files as it is told
findings      everything that was found, and the files
diagnosis     the causes told, the verdict and the result file
diagnose      all of it in order
"""
