"""Grade submissions once each; write results as they come."""

from __future__ import annotations

import copy
import hashlib
import json
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from reports.grading.batch.decisions import (
    Decision,
    applied,
    decided,
    decided_groups,
    from_gradebook,
    load_decisions,
    of_groups,
    refuse_too_many,
    refuse_wrong_words,
    save_decisions,
    student_of,
    waiting,
    words_of_groups,
)
from reports.grading.batch.memory import keep_past, kept_past, remember, remembered
from reports.grading.batch.pool import Job, Outcome, grade_all, grade_far
from reports.grading.batch.requests import add_request, load_requests, with_requests
from reports.grading.batch.run_setup import (
    RESULTS,
    Pseudonyms,
    fill_form,
    put_off,
    refuse_another_class,
    refuse_overlap,
    write_copies,
    write_questions,
)
from reports.grading.batch.settled import (
    as_graded,
    file_stem,
    is_settled,
    plain_row,
    result_text,
    settled,
)
from reports.grading.batch.setup import Effect, Graded, GradeSetup, progress_words
from reports.grading.issuing.register import FILE, Register, checked_register, load_register
from reports.grading.issuing.roster import read_roster
from reports.grading.issuing.rubric import load_rubric
from reports.grading.judging.collusion import Past, Ring, rings_of
from reports.grading.judging.marking import FORMAT, Marker, blank_result
from reports.grading.judging.similarity import suspicions
from reports.grading.judging.work_digest import Shared, Work, work_of
from reports.grading.pages.gradebook import gradebook_csv, gradebook_xlsx, moodle_csv
from reports.grading.pages.moodle import feedback_zip, filled, read_worksheet
from reports.grading.pages.pages import class_page, student_page
from reports.grading.pages.side_by_side import comparisons
from reports.grading.pages.states import state_of, state_of_result
from reports.grading.pages.summary import choose, summarise, table_rows, waiting_groups
from reports.grading.reading.submissions import Submission, collect
from reports.shared.background import processors
from reports.shared.errors import InputError, Problem
from reports.shared.files import make_dir, read_json, write_bytes, write_text
from reports.shared.progress import Progress
from reports.shared.resources import source_digest

PAGES, _PAST = "pages", "past.json"
_EVERY_S = 5.0  # how often the gradebook is written anew while the batch runs


def grade(
    issued: Path,
    submitted: Path,
    folder: Path,
    *,
    rubric_file: Path | None = None,
    secret_file: Path | None = None,
    options: GradeSetup | None = None,
) -> Graded:
    """Grade everything that was handed in.

    Raises:
        InputError: the register, the rubric or the secret is wrong, or nothing was handed in.
        OutputError: the folder cannot be written.
    """
    started = time.monotonic()
    options = options or GradeSetup()
    register = checked_register(issued, secret_file)
    if rubric_file is not None:
        register = replace(register, rubric=load_rubric(rubric_file))
        Marker(register).assignment(register.books[0])  # the rubric must fit the engine
    if options.roster is not None:
        register = put_off(register, read_roster(options.roster))
    if options.worksheet is not None:
        read_worksheet(options.worksheet)  # a wrong one is told before the work
    submissions = collect(submitted)
    refuse_overlap(submitted, folder, issued)
    refuse_another_class(folder, register)
    batch = _Batch(register, folder, anonymous=options.anonymous)
    if options.memory is not None:
        batch.past = remembered(options.memory, batch.class_id)
    batch.check(options, submissions)
    make_dir(folder)
    batch.start(submissions)
    if options.memory is not None:
        keep_past(folder / RESULTS / _PAST, batch.past)
    workers = min(options.workers or processors(), processors())
    outcomes = (
        grade_far(
            batch.waiting, batch.register_file, timeout_s=options.timeout_s, dask=options.dask
        )
        if options.dask
        else grade_all(
            batch.waiting, batch.register_file, workers=workers, timeout_s=options.timeout_s
        )
    )
    with Progress("Проверка работ") as progress:
        for outcome in outcomes:
            batch.take(outcome)
            progress.step(progress_words(len(batch.works), len(submissions), batch.reused, started))
        refused = batch.decide(options)
        summary = batch.finish()
    if options.memory is not None:
        remember(options.memory, batch.class_id, batch.counted())
    if refused is not None:
        raise refused
    if options.worksheet is not None:
        batch.fill_worksheet(options.worksheet)
    if options.form is not None:
        fill_form(folder, batch.table(), register.rubric, options.form)
    if options.copies:
        write_copies(
            folder, batch.results(submissions), register.rubric, workers, options.timeout_s
        )
    if options.questions:
        write_questions(folder, batch.counted(), Marker(register), batch.shown)
    if options.pdf:
        batch.write_pdf()
    return Graded(folder, summary, batch.reused, time.monotonic() - started)


def decide(folder: Path, options: GradeSetup) -> Graded:
    """Take a person's decisions into the results of an earlier run.

    Raises:
        InputError: there are no results, or a decision names no student or item.
    """
    started = time.monotonic()
    register, known = load_register(folder / RESULTS / FILE), read_json(folder / "summary.json")
    batch = _Batch(register, folder, anonymous=bool(known.get("anonymous")))
    batch.take_over()
    batch.ask(options.requests)
    batch.check(options)
    if (refused := batch.decide(options)) is not None:
        raise refused
    if options.preview:
        return Graded(folder, batch.summary(), len(batch.works), time.monotonic() - started,
                      batch.effects)  # fmt: skip
    summary = batch.finish()
    if options.form is not None:
        fill_form(folder, batch.table(), register.rubric, options.form)
    return Graded(folder, summary, len(batch.works), time.monotonic() - started, batch.effects)


class _Batch:
    """The results of a batch on disk, so that it can be stopped and started again.

    In memory there is only what the tables of the class need of each work.
    """

    def __init__(self, register: Register, folder: Path, *, anonymous: bool = False) -> None:
        self.register, self.folder = register, folder
        self._veil = Pseudonyms(register) if anonymous else None
        self.works: dict[str, Work] = {}
        self._shared: Shared = {}
        self.waiting: list[Submission] = []
        self.register_file = folder / RESULTS / FILE
        self._written = time.monotonic()
        self._rules = hashlib.sha256(
            f"{source_digest()} {anonymous} {register.json_text()}".encode()
        ).hexdigest()
        self._hashes: dict[str, str] = {}
        self._sha256: dict[str, str] = {}
        self._taken_over = 0
        self._requests = load_requests(folder)
        self._kept: list[Decision] = []  # decisions of before, and of the gradebook
        self._by_group: list[tuple[str, str, str, str]] = []  # what the gradebook says of groups
        self._group_author = ""
        self.past: Past = kept_past(folder / RESULTS / _PAST)
        self._stands = (folder / "gradebook.xlsx").exists()  # of an earlier run, to the end
        self.effects: list[Effect] = []
        self._settled: set[str] = set()  # keys of results whose files say more than the program

    @property
    def class_id(self) -> str:
        """Identity of a class in the memory of years: nobody's name, no number of a variant."""
        return self.register.trial_seed[:12]

    def shown(self, page: str, *files: str) -> str:
        """Return a page as people see it: with numbers for names where that is asked."""
        return page if self._veil is None else self._veil.over(page, files)

    def by_number(self) -> dict[int, Work]:
        """Return the work that counts of each student, by the number of the variant."""
        return choose(list(self.works.values()), self.register.rubric.attempts)

    def counted(self) -> list[Work]:
        """Return the work that counts of each student."""
        return [work for _, work in sorted(self.by_number().items())]

    def results(self, submissions: Sequence[Submission]) -> list[Job]:
        """Return the files that count with their results, as people have decided."""
        by_key = {submission.key: submission for submission in submissions}
        decisions = load_decisions(self.folder)
        return [
            (by_key[work.key], applied(self._result(work), decisions), work)
            for work in self.counted()
            if work.status == "graded" and work.key in by_key
        ]

    def rings(self) -> list[Ring]:
        """Works with a common origin, those of earlier classes among them."""
        works = [work for work in self.ordered if work.status == "graded"]
        return rings_of(works, self.past, past_holds=self.register.rubric.copying.past == "hold")

    @property
    def reused(self) -> int:
        """Results taken over from an earlier run."""
        return self._taken_over

    def take_over(self) -> None:
        """All results of an earlier run, whatever was handed in since.

        Raises:
            InputError: there are none.
        """
        for _, result in self._results():
            self._keep(result)
        if not self.works:
            hint = "укажите папку, в которую проверены работы"
            raise InputError(Problem(str(self.folder), "здесь нет проверенных работ", hint))

    @property
    def _asked(self) -> set[int]:
        return {each.number for each in self._requests}

    def ask(self, requests: Sequence[tuple[str, str, str]]) -> None:
        """Keep students' requests for another look; InputError where one is none."""
        for who, column, text in requests:
            work = self.by_number().get(student_of(self.register, self.works.values(), who).number)
            if work is not None:
                decided_result = applied(self._result(work), load_decisions(self.folder))
                seen = work_of(decided_result, self._shared)
                self._requests = add_request(self.folder, seen, column, text)

    def check(self, options: GradeSetup, submissions: Sequence[Submission] = ()) -> None:
        """Read what people have decided, before anything is written.

        Raises:
            InputError: some of it is no decision, or none under the rubric of today.
        """
        decisions = load_decisions(self.folder)
        rubric, book = self.register.rubric, self.folder / "gradebook.xlsx"
        seen = [work_of(applied(result, decisions), self._shared) for _, result in self._results()]
        counted = choose(seen, rubric.attempts)
        self._kept = from_gradebook(book, decisions, counted, rubric)
        self._by_group, self._group_author = words_of_groups(book, decisions)
        refuse_too_many(self._kept, self.register)
        if submissions and options.decisions:
            items = Marker(self.register).assignment(self.register.books[0])[0].items
            files = {name for one in submissions for name in (one.key, one.label)}
            ids = {item.id for item in items}
            refuse_wrong_words(options.decisions, self.register, files, ids)

    def decide(self, options: GradeSetup) -> InputError | None:
        """Take in what people have decided, and what the command says; why not, if it cannot be."""
        kept, refused = self._kept, None
        before = load_decisions(self.folder)
        counted = self._decided(kept, also=before)  # what was seen before the new words
        works, decisions = list(self.works.values()), kept
        groups = waiting_groups(self.register, self.ordered, self.rings())
        names = {group.name for group in groups} | {entry.group for entry in kept}
        # What the gradebook says of a group that waits no more was taken in before.
        by_group = [words for words in self._by_group if words[0] in names]
        try:
            spoken = of_groups(by_group, groups, kept, anew=True)
            decisions = decided(kept, self.register, works, counted, spoken, self._group_author)
            spoken = of_groups(options.decisions, groups, decisions)
            decisions = decided(decisions, self.register, works, counted, spoken, options.author)
        except InputError as error:
            refused = error
        if options.preview:
            self.effects = [] if refused else self._effects(kept, decisions)
            return refused
        self.effects = self._effects(kept, decisions)
        if decisions or before:
            save_decisions(self.folder, decisions)
        if decisions != kept:
            self._decided(decisions, also=kept)
        return refused

    def _effects(self, before: Sequence[Decision], after: Sequence[Decision]) -> list[Effect]:
        """Students whom the new decisions are about, their points before and after."""
        touched = {entry.number for entry in {*before} ^ {*after}}
        counted = self.by_number()
        lines = []
        for number in sorted(touched & counted.keys()):
            program = self._result(counted[number])
            points = [applied(program, decisions).get("points") for decisions in (before, after)]
            lines.append((counted[number].student, points[0], points[1]))
        return lines

    def _decided(
        self, decisions: Sequence[Decision], also: Sequence[Decision] = ()
    ) -> dict[int, Work]:
        """Take decisions into the works of their students; which works count then."""
        touched = {entry.number for entry in (*decisions, *also)} | self._asked
        results = {
            work.key: applied(self._result(work), decisions)
            for work in self.works.values()
            if work.number in touched
        }
        for result in results.values():
            self._keep(result)
        counted = self.by_number()
        for key, result in results.items():
            if counted[result["number"]].key == key:
                self._keep(waiting(result, decisions))
        return counted

    def _settle(self, rows: Sequence[dict[str, Any]], rings: Sequence[Ring]) -> None:
        """Write the pages and results anew that say less than the gradebook."""
        decisions = load_decisions(self.folder)
        touched = {entry.number for entry in decisions} | self._asked
        doubts = suspicions(self.ordered, rings)
        of_rows = {row["result"].key: row for row in rows if row["result"] is not None}
        for work in self.ordered:
            row = of_rows.get(work.key)
            why = () if work.decision else row["doubts"] if row else doubts.get(work.key, ())
            state = row["status"] if row else state_of(work.status, work.manual, why)
            is_plain = state == state_of(work.status, work.manual, work.doubts)
            if is_plain and work.number not in touched and work.key not in self._settled:
                continue
            program = self._result(work)
            decided = applied(copy.deepcopy(program), decisions)
            decided = waiting(decided, decisions) if row else decided
            final = settled(program, decided, state, why)
            page = self.shown(
                student_page({**decided, "state": state}, self.register.rubric), decided["file"]
            )
            write_text(self.folder / work.page, page)
            write_text(self._json_of(work), result_text(final))

    def _result(self, work: Work) -> dict[str, Any]:
        """Return the result of a work as the program has made it."""
        result: dict[str, Any] = json.loads(self._json_of(work).read_text(encoding="utf-8"))
        return with_requests(as_graded(result), self._requests)

    def _json_of(self, work: Work) -> Path:
        return self.folder / RESULTS / f"{Path(work.page).stem}.json"

    def start(self, submissions: Sequence[Submission]) -> None:
        """Take over what an earlier run has finished of the same files under the same rules."""
        make_dir(self.folder / RESULTS)
        make_dir(self.folder / PAGES)
        write_text(self.register_file, self.register.json_text())
        keys = {submission.key for submission in submissions}
        done = self._earlier(keys)
        for submission in submissions:
            self._hashes[submission.key] = self._fingerprint(submission)
            earlier = done.get(submission.key)
            if earlier and earlier.fingerprint == self._hashes[submission.key]:
                self.works[submission.key] = earlier
                self._taken_over += 1
            else:
                self.waiting.append(submission)

    def _keep(self, result: dict[str, Any]) -> None:
        self.works[result["key"]] = work_of(result, self._shared)

    def _results(self) -> Iterator[tuple[Path, dict[str, Any]]]:
        """Return the results of an earlier run that can be read."""
        for path in sorted((self.folder / RESULTS).glob("*.json")):
            result = read_json(path) if path.name != FILE else {}
            if result.get("format") == FORMAT and result.get("fingerprint"):
                if is_settled(result):
                    self._settled.add(result["key"])
                yield path, as_graded(result)

    def _earlier(self, keys: set[str]) -> dict[str, Work]:
        earlier = {}
        for path, result in self._results():
            key, page = result["key"], self.folder / result["page"]
            if key in keys and page.exists():
                earlier[key] = work_of(result, self._shared)
            else:  # of a file that is no longer there
                path.unlink(missing_ok=True)
                if page.parent == self.folder / PAGES:
                    page.unlink(missing_ok=True)
        return earlier

    def _fingerprint(self, submission: Submission) -> str:
        try:
            data = hashlib.sha256(submission.read()).hexdigest()
        except InputError as error:
            data = str(error)
        self._sha256[submission.key] = data
        parts = f"{data} {submission.key} {submission.time} {submission.clock} {self._rules}"
        return hashlib.sha256(parts.encode()).hexdigest()

    def take(self, outcome: Outcome) -> None:
        """Write one result and its page."""
        submission, result, page = outcome.submission, outcome.result, outcome.page
        if result is None:
            marker = Marker(self.register)
            blank = blank_result(submission)
            blank["sha256"] = self._sha256[submission.key]
            result = marker.refused(blank, submission, outcome.problem)
            page = student_page(result, self.register.rubric)
        stem = file_stem(result, number_only=self._veil is not None)
        result["fingerprint"] = self._hashes[submission.key]
        result["page"] = f"{PAGES}/{stem}.html"
        write_text(self.folder / result["page"], self.shown(page, result["file"]))
        stated = {**result, "state": state_of_result(result)}
        write_text(self.folder / RESULTS / f"{stem}.json", result_text(stated))
        self._settled.discard(result["key"])
        self._keep(result)
        if not self._stands and time.monotonic() - self._written > _EVERY_S:
            table = gradebook_csv(
                table_rows(self.register, self.ordered), self.register.rubric.maximum
            )
            write_text(self.folder / "gradebook.csv", table)
            self._written = time.monotonic()

    @property
    def ordered(self) -> list[Work]:
        """Works in the order of their keys, whatever the order in which they came."""
        return [self.works[key] for key in sorted(self.works)]

    def table(self) -> list[dict[str, Any]]:
        """Rows of the gradebook, with what rings hold."""
        return table_rows(self.register, self.ordered, self.rings())

    def summary(self) -> dict[str, Any]:
        """Everything that the page of the class shows."""
        return summarise(self.register, self.ordered, self.rings())

    def finish(self) -> dict[str, Any]:
        """All tables, the page of the class and its JSON: made first, then written together."""
        rings = self.rings()
        rows = table_rows(self.register, self.ordered, rings)
        summary = summarise(self.register, self.ordered, rings)
        summary["decided"] = decided_groups(load_decisions(self.folder), self.by_number())
        compared = comparisons(rings, self._result)
        summary["compared"] = [{"page": each.page, "text": each.text} for each in compared]
        self._settle(rows, rings)
        maximum = self.register.rubric.maximum
        data = {**summary, "rows": [plain_row(row) for row in rows], "anonymous": bool(self._veil)}
        text = json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1)
        names = [work.file for work in self.ordered]
        files: dict[str, str | bytes] = {
            "gradebook.csv": gradebook_csv(rows, maximum),
            "gradebook.xlsx": gradebook_xlsx(rows, maximum, summary["groups"], summary["decided"]),
            "moodle.csv": moodle_csv(rows),
            "summary.html": self.shown(class_page(summary), *names),
            "summary.json": text + "\n",
        }
        files |= {each.page: self.shown(each.html, *names) for each in compared}
        if any(work.moodle_id for work in self.ordered):
            files["moodle-feedback.zip"] = feedback_zip(rows, self.folder)
        for name, content in files.items():
            write_bytes(
                self.folder / name, content if isinstance(content, bytes) else content.encode()
            )
        return summary

    def fill_worksheet(self, path: Path) -> None:
        """Moodle's worksheet with the grades; InputError if it is none."""
        maximum = self.register.rubric.maximum
        worksheet = filled(read_worksheet(path), self.table(), maximum, path.name)
        write_text(self.folder / "moodle-worksheet.csv", worksheet.text)

    def write_pdf(self) -> None:
        """Write a PDF beside every page.

        Raises:
            SystemPartMissing: pango is not on this machine.
        """
        from reports.document.page.render import render
        from reports.shared.doctor import need_pango

        need_pango()
        for work in self.ordered:
            page = self.folder / work.page
            pdf = render(page.read_text(encoding="utf-8"), variant=None)
            write_bytes(page.with_suffix(".pdf"), pdf.pdf)
