# SPDX-License-Identifier: GPL-2.0-or-later
# The pages of the package as HTML: cmake --build BUILD --target pages. Links to pages of LAMMPS
# itself go to its manual.
import os
import re

from docutils import nodes
from pygments.lexers.special import TextLexer

project = 'LSM package for LAMMPS'
copyright = 'the authors; GNU General Public License, version 2 or later'
html_theme = 'alabaster'
html_copy_source = False

HERE = os.path.dirname(os.path.abspath(__file__))
OWN = {name[:-4] for name in os.listdir(HERE) if name.endswith('.rst')}
MANUAL = 'https://docs.lammps.org/'


def title_and_page(text):
    title, _, page = text.rpartition('<')
    page = page.rstrip('>').strip()
    return title.strip() or page, page


def page_of_lammps(name, rawtext, text, lineno, inliner, options=None, content=None):
    title, page = title_and_page(text)
    return [nodes.reference(rawtext, title, refuri=f'{MANUAL}{page}.html', internal=False)], []


def roles(app, docname, source):
    """Before a page is read: a :doc: that names no page of ours becomes a link to the manual."""

    def role(match):
        return match.group(0) if title_and_page(match.group(1))[1] in OWN else f':lammps:`{match.group(1)}`'

    source[0] = re.sub(r':doc:`([^`]*)`', role, source[0])


def setup(app):
    app.add_role('lammps', page_of_lammps)
    app.add_lexer('LAMMPS', TextLexer)  # LAMMPS marks its input by a lexer of its own; here it is plain text
    app.connect('source-read', roles)
    return {'parallel_read_safe': True}
