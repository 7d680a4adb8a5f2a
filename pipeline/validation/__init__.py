"""The cross-validation of bar and parallelogram: FEA, VJM and the straight line side by side."""
