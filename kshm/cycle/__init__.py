"""The working cycle after Grinevetsky and Mazing: an island of its own."""
