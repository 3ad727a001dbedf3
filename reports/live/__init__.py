"""The live page: an engine as one file of HTML that calculates itself."""
