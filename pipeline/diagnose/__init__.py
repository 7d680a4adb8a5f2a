"""Which physical effect a model lacks: screened, fitted, chosen, told apart from its rivals, or refused."""
