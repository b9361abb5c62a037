"""The screens of the App: Textual screens and dialogs, and what they share."""
