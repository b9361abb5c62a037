"""The screens: one Textual Screen or ModalScreen a module."""
