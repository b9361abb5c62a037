"""This package runs word-address programs: text to words, words to modal state, modal state to programmed moves."""
