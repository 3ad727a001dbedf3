"""``python -m tools.manual DOCS [--site DIR] [--pictures]``: renew the pages of a checkout."""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("docs", type=click.Path(path_type=Path, exists=True, file_okay=False))
@click.option("--site", type=click.Path(path_type=Path), help="Папка для страниц HTML.")
@click.option("--pictures", is_flag=True, help="Сделать заново рисунки (нужен LibreOffice).")
def main(docs: Path, site: Path | None, pictures: bool) -> None:
    """Обновить страницы документации и проверить ссылки."""
    from tools.manual.pages import write_pages
    from tools.manual.site import broken_links, write_site

    for path in write_pages(docs):
        click.echo(f"обновлено: {path}")
    if pictures:
        from tools.manual.pictures import write_pictures
        from tools.manual.style_pictures import write_style_pictures

        styles = docs.parent / "samples" / "styles"
        for path in (*write_pictures(docs / "images"), *write_style_pictures(styles)):
            click.echo(f"рисунок: {path}")
    if site is not None:
        click.echo(f"страниц HTML: {len(write_site(docs, site))} в {site}")
    broken = broken_links([*docs.glob("*.md"), *docs.parent.glob("README*.md")])
    for line in broken:
        click.echo(f"ссылка никуда не ведёт: {line}", err=True)
    if broken:
        sys.exit(1)


main()
