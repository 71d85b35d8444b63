"""Two networks compared by their structure, whatever their parts are called.

compare   - what one network has more, less or different than another one
matching  - which node of one network is which of the other
reduced   - a network without the massless nodes inside its series connections
make      - what two branches have to have in common to be of one structure
"""

from dashpot.model.likeness.compare import Likeness, compare_structures

__all__ = ["Likeness", "compare_structures"]
