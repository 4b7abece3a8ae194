"""The verbs of culm that run decks many times or draw pages: study, hard, effects, report."""
