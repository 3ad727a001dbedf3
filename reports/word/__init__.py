"""The report as a Word document, written from the same page that the PDF is set from."""
