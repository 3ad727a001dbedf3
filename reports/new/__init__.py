"""New engines as input files: generated of usual values, or scaled from another one."""
