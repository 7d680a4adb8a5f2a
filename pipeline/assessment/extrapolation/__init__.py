"""Beyond the loads that were fitted: the diagnosis beside what else could be done with the same campaign."""
