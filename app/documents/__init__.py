"""This package opens, journals, saves and locks contour programs and NC texts; it knows no screen.

`document_service.DocumentService` is all that the App and the screens need.  A `Document` is a value; every edit makes
a new one, which goes to `keep` before the next key is read.  A question comes back as a `questions.QuestionText`, a
failure as a sentence:

    opened = service.open(path)                                   Opened or Trouble
    while opened.offer: opened = service.answer(opened.document, opened.offer, word)
    notice = service.keep(document.edited(...))                   after every edit, undo and redo
    saved = service.save(document, path, agreed)                  Saved, Trouble, or a QuestionText,
                                                                  whose answer joins `agreed`
    service.close(document)                                       saved or abandoned: nothing stays
    service.stop()                                                the end, wanted or not: unsaved work stays
"""
