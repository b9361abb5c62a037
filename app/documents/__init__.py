"""Documents: contour programs and NC texts, opened, kept, saved and locked by one service that knows no screen.

`service.DocumentService` is all that the App and the screens need.  A `Document` is a value; every edit makes a new
one, which goes to `keep` before the next key is read.  What must be asked comes back as a `questions.Ask`, what went
wrong as a sentence:

    opened = service.open(path)                                   Opened or Trouble
    while opened.offer: opened = service.answer(opened.document, opened.offer, word)
    notice = service.keep(document.edited(...))                   after every edit, undo and redo
    saved = service.save(document, path, agreed)                  Saved, Trouble, or an Ask (its answer joins `agreed`)
    service.close(document)                                       saved or given up: nothing stays
    service.stop()                                                the end, wanted or not: what is unsaved stays kept
"""
