"""``python -m kshm`` runs the command ``kshm``, whose home is another package."""

import runpy

# By name only: the solver itself knows nothing of files and people.
runpy.run_module("reports", run_name="__main__", alter_sys=True)
