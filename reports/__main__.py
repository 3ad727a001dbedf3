"""``python -m reports`` is ``kshm``."""

from reports.cli import main

main()
