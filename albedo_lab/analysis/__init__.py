"""Questions asked of estimates, answered as tidy DataFrames."""
