// SPDX-License-Identifier: GPL-2.0-or-later
// The selection on the page, and the views that follow it.
'use strict';

class App {
  constructor(page, runs) {
    this.page = page;
    this.runs = runs;
    this.run = runs[0];
    this.kind = runs[0].kinds[0].info.kind;
    this.chosen = null;  // {run, kind, index}
    this.threshold = 0;
    this.views = [];
  }

  /** The events of a run that are shown: of the kind chosen, or of the only kind. */
  eventsOf(run) { return run.kinds.find(kind => kind.info.kind === this.kind) || run.kinds[0]; }
  get view() { return this.views[this.runs.indexOf(this.run)]; }

  /** Index of the chosen event if it is one of this run, else null. */
  chosenIn(run) {
    return this.chosen && this.chosen.run === run && this.chosen.kind === this.eventsOf(run).info.kind ? this.chosen.index : null;
  }

  start() {
    document.getElementById('page').hidden = false;
    this.statistics = new Statistics(this);
    this.statistics.showKind();
    this.event = new EventPanel(this);
    this.table = new EventTable(this);
    this.tableSoon = oncePerFrame(() => this.table.draw());
    const box = document.getElementById('views');
    this.runs.forEach((run, number) => this.views.push(new View(run, number, box, this)));
    this.makeTools();
    this.showParameters();
    this.choose(this.run, this.eventsOf(this.run).bySize[0]);
    this.activate(this.views[0]);
    this.table.draw();
    this.summarise();
  }

  makeTools() {
    const on = (id, action) => document.getElementById(id).addEventListener('click', action);
    on('whole-run', () => this.view.show(this.view.begin, this.view.end));
    on('largest-event', () => this.choose(this.run, this.eventsOf(this.run).bySize[0], true));
    on('previous-event', () => this.step(-1));
    on('next-event', () => this.step(1));
    const kinds = new Set(this.runs.flatMap(run => run.kinds.map(kind => kind.info.kind)));
    const select = document.getElementById('kind');
    for (const kind of kinds) select.append(element('option', kind === 'drops' ? 'drops of PE (as in the paper)' : kind, {value: kind}));
    select.addEventListener('change', () => this.setKind(select.value));
    for (const label of document.querySelectorAll('.only-kinds')) label.hidden = kinds.size < 2;
  }

  setKind(kind, index = null) {
    this.kind = kind;
    document.getElementById('kind').value = kind;
    this.chosen = null;
    this.statistics.showKind();
    this.choose(this.run, index === null ? this.eventsOf(this.run).bySize[0] : index);
    this.table.draw();
    this.table.mark();
    for (const view of this.views) view.refreshSoon();
    this.summarise();
  }

  /** Makes a run the one of table and buttons. */
  activate(view) {
    const changed = this.run !== view.run;
    this.run = view.run;
    for (const other of this.views) other.box.classList.toggle('active', this.runs.length > 1 && other === view);
    if (changed && this.table) this.table.draw();
    if (changed && (!this.chosen || this.chosen.run !== this.run)) this.choose(this.run, this.eventsOf(this.run).bySize[0]);
  }

  choose(run, index, zoom = false) {
    this.chosen = {run, kind: this.eventsOf(run).info.kind, index};
    if (this.run !== run) this.activate(this.views[this.runs.indexOf(run)]);
    this.event.show(run, index);
    this.table.mark();
    if (zoom) this.zoomToEvent();
    else for (const view of this.views) view.refreshSoon();
  }

  chooseOther(run, events, index) {
    this.run = run;
    this.setKind(events.info.kind, index);
    this.zoomToEvent();
  }

  /** The event before or after the chosen one in time. */
  step(by) {
    const events = this.eventsOf(this.run), current = this.chosenIn(this.run);
    const index = current === null ? 0 : Math.min(Math.max(current + by, 0), events.length - 1);
    const [from, to] = this.view.window, begin = events.columns.t_start[index];
    this.choose(this.run, index, begin < from || events.columns.t_end[index] > to || to - from < 0.5 * (this.view.end - this.view.begin));
  }

  zoomToEvent() {
    const {run, index} = this.chosen, {t_start, t_end} = this.eventsOf(run).columns;
    const view = this.views[this.runs.indexOf(run)];
    const room = Math.max(t_end[index] - t_start[index], run.series ? 10 * run.series.info.spacing : 0, 1e-9);
    view.show(t_start[index] - room, t_end[index] + room);
    for (const other of this.views) if (other !== view) other.refreshSoon();
  }

  setThreshold(size) {
    if (size === this.threshold) return;
    this.threshold = size;
    this.statistics.draw();
    for (const view of this.views) view.refreshSoon();
  }

  windowChanged() {
    if (document.getElementById('in-view').checked) this.tableSoon();
  }

  showParameters() {
    const columns = this.runs.flatMap(run => run.kinds.map(kind => ({run, kind, values: new Map(kind.info.parameters)})));
    const head = element('tr');
    head.append(element('th', 'Parameter', {scope: 'col'}));
    const several = this.runs.some(run => run.kinds.length > 1);
    for (const {run, kind} of columns)
      head.append(element('th', run.info.label + (several ? (kind.info.kind === 'drops' ? ', drops of PE' : ', ruptures') : ''), {scope: 'col'}));
    const table = document.getElementById('parameters');
    table.tHead.replaceChildren(head);
    const names = [...new Set(columns.flatMap(column => [...column.values.keys()]))];
    table.tBodies[0].replaceChildren(...names.map(name => {
      const row = element('tr'), texts = columns.map(({values}) => values.has(name) ? values.get(name) : '–');
      row.append(element('th', name, {scope: 'row'}));
      for (const text of texts) row.append(element('td', text.length > 8 && text.trim() !== '' && Number.isFinite(Number(text)) ? short(Number(text), 10) : text));
      const ofRuns = this.runs.map(run => new Map(run.kinds[0].info.parameters).get(name));
      if (new Set(ofRuns).size > 1) row.className = 'differs';
      return row;
    }));
    document.getElementById('program').textContent = this.page.program;
    const files = this.runs.flatMap(({info}) => [...info.kinds.map(kind => kind.file), info.series && info.series.file, info.history && info.history.file]);
    document.getElementById('files').textContent = files.filter(Boolean).join(', ');
  }

  summarise() {
    const parts = this.runs.map(run => {
      const events = this.eventsOf(run), {columns, info} = events, i = events.bySize[0], view = this.views[this.runs.indexOf(run)];
      const joined = run.series && run.series.info.kept < run.series.info.samples
        ? `; of ${run.series.info.samples} samples the smallest and largest of each few are kept` : '';
      return `${this.runs.length > 1 ? `${run.info.label}: ` : ''}${info.count} ${info.kind === 'drops' ? unitsOf(run).events : info.kind} in ${short(view.end - view.begin, 6)} ${unitsOf(run).duration}; ` +
        `the largest, ${columns.event_id[i]}, has size ${short(columns.size[i], 4)} and begins at time ${short(columns.t_start[i], 8)}${joined}.`;
    });
    const repairs = this.runs.flatMap(run => run.kinds.flatMap(kind => kind.info.repairs));
    document.getElementById('summary').textContent = [...parts, ...repairs].join(' ');
  }
}

(async () => {
  const page = JSON.parse(document.getElementById('data').textContent);
  const summary = document.getElementById('summary');
  try {
    if (typeof DecompressionStream === 'undefined')
      throw new Error('this browser is too old for the page, which needs DecompressionStream (2023 and later)');
    const runs = await Promise.all(page.runs.map(loadRun));
    window.app = new App(page, runs);
    window.app.start();
    document.body.dataset.state = 'ready';
  } catch (error) {
    document.body.dataset.state = 'failed';
    summary.textContent = `The page cannot be shown: ${error.message}`;
    throw error;
  }
})();
