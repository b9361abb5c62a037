"""Prompt says what the field with the cursor takes, or why something was refused."""

from __future__ import annotations

from app.session.messages import Sentence, Tone
from app.widgets.plain import PlainText


class Prompt(PlainText):
    """Two lines above the status line."""

    def __init__(self) -> None:
        super().__init__(id="prompt")
        self.sentence = Sentence("")

    def show(self, sentence: Sentence) -> None:
        """Show a sentence in its tone; do nothing if it is shown already."""
        if sentence == self.sentence:
            return
        if sentence.tone is not self.sentence.tone:
            for tone in (Tone.WARNING, Tone.ERROR):
                self.set_class(sentence.tone is tone, f"-{tone}")
        self.sentence = sentence
        self.update(sentence.text, layout=False)
