"""From measurements to what is missing in the model: prediction, residuals, fit."""
