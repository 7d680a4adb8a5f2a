"""Whether a model is adequate: what it leaves is noise, or too little to tell."""
