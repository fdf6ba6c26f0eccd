// SPDX-License-Identifier: GPL-2.0-or-later
// The table of events: sorted by a column, filtered by size, time and place.
'use strict';

class EventTable {
  static page = 100;
  static order = ['event_id', 't_start', 'duration', 'size', 'slip_moment', 'x_centroid', 'rupture_length', 'mean_slip', 'peak_slip', 'stress_drop'];

  constructor(app) {
    this.app = app;
    this.find = id => document.getElementById(id);
    this.sortBy = 'size';
    this.falling = true;
    this.rows = EventTable.page;
    const again = oncePerFrame(() => { this.rows = EventTable.page; this.draw(); });
    this.find('filters').addEventListener('input', again);
    this.find('filters').addEventListener('reset', () => setTimeout(again));
    this.find('filters').addEventListener('submit', event => event.preventDefault());
    this.find('more-rows').addEventListener('click', () => { this.rows += EventTable.page; this.draw(); });
    this.find('rows').addEventListener('click', event => this.click(event));
    this.find('rows').addEventListener('keydown', event => this.key(event));
  }

  get events() { return this.app.eventsOf(this.app.run); }
  get columns() { return EventTable.order.filter(name => name === 'duration' || this.events.has(name)); }

  limit(id, none) {
    const text = this.find(id).value.trim().replace('−', '-'), value = Number(text);
    this.find(id).setAttribute('aria-invalid', String(text !== '' && Number.isNaN(value)));
    return text === '' || Number.isNaN(value) ? none : value;
  }

  /** Indices of the events that the filters leave, in the order of the table. */
  chosen() {
    const events = this.events, {t_start, size} = events.columns, place = events.place && events.columns[events.place];
    const [low, high] = [this.limit('size-from', -Infinity), this.limit('size-to', Infinity)];
    let [from, to] = [this.limit('time-from', -Infinity), this.limit('time-to', Infinity)];
    const [left, right] = [this.limit('place-from', -Infinity), this.limit('place-to', Infinity)];
    if (this.find('in-view').checked) {
      const view = this.app.view.window;
      from = Math.max(from, view[0]);
      to = Math.min(to, view[1]);
    }
    // A stretch that begins behind its end continues across the border of the periodic fault.
    const there = x => left <= right ? x >= left && x <= right : x >= left || x <= right;
    const out = [];
    for (const i of events.bySize)
      if (size[i] >= low && size[i] <= high && t_start[i] >= from && t_start[i] <= to && (!place || there(place[i]))) out.push(i);
    if (this.sortBy === 'size') return this.falling ? out : out.reverse();
    const sign = this.falling ? -1 : 1;
    return out.sort((a, b) => sign * (events.get(this.sortBy, a) - events.get(this.sortBy, b)) || a - b);
  }

  draw() {
    const events = this.events, columns = this.columns;
    if (!columns.includes(this.sortBy)) { this.sortBy = 'size'; this.falling = true; }
    for (const label of document.querySelectorAll('.only-places')) label.hidden = !events.place;
    const head = element('tr');
    for (const name of columns) {
      const cell = element('th', undefined, {scope: 'col', 'aria-sort': name !== this.sortBy ? 'none' : this.falling ? 'descending' : 'ascending'});
      const mark = name !== this.sortBy ? '' : this.falling ? ' ▼' : ' ▲';
      cell.append(element('button', columnNames[name][0] + mark, {type: 'button', 'data-sort': name, title: `Sort by ${name}`}));
      head.append(cell);
    }
    this.find('rows').tHead.replaceChildren(head);
    this.indices = this.chosen();
    const body = this.find('rows').tBodies[0], current = this.app.chosenIn(this.app.run);
    body.replaceChildren(...this.indices.slice(0, this.rows).map((i, k) => {
      const row = element('tr', undefined, {'data-index': String(i), tabindex: k === 0 ? '0' : '-1', 'aria-selected': String(i === current)});
      for (const name of columns) row.append(element('td', name === 'event_id' ? String(events.columns.event_id[i]) : short(events.get(name, i), 6)));
      return row;
    }));
    const left = events.info.count - events.info.listed;
    this.find('table-count').textContent = `${this.indices.length} of ${events.info.count} events` +
      (left > 0 ? `; the ${left} smallest are not on this page` : '') +
      (this.indices.length > this.rows ? `, the first ${this.rows} shown` : '');
    this.find('more-rows').hidden = this.indices.length <= this.rows;
  }

  /** Marks the chosen event; brings its row into sight if there is one. */
  mark() {
    const current = this.app.chosenIn(this.app.run);
    for (const row of this.find('rows').tBodies[0].rows) {
      const is = Number(row.dataset.index) === current;
      row.setAttribute('aria-selected', String(is));
      if (!is) continue;
      const frame = this.find('rows-frame');
      if (row.offsetTop < frame.scrollTop + 30) frame.scrollTop = row.offsetTop - 30;
      else if (row.offsetTop + row.offsetHeight > frame.scrollTop + frame.clientHeight) frame.scrollTop = row.offsetTop + row.offsetHeight - frame.clientHeight;
    }
  }

  click(event) {
    const sort = event.target.closest('[data-sort]');
    if (sort) {
      this.falling = this.sortBy === sort.dataset.sort ? !this.falling : sort.dataset.sort !== 'event_id' && sort.dataset.sort !== 't_start';
      this.sortBy = sort.dataset.sort;
      const name = sort.dataset.sort;
      this.draw();
      this.find('rows').querySelector(`[data-sort="${name}"]`).focus();
      return;
    }
    const row = event.target.closest('tr[data-index]');
    if (row) this.app.choose(this.app.run, Number(row.dataset.index), true);
  }

  key(event) {
    const row = event.target.closest('tr[data-index]');
    if (!row) return;
    const go = {ArrowDown: row.nextElementSibling, ArrowUp: row.previousElementSibling}[event.key];
    if (event.key === 'Enter' || event.key === ' ') this.app.choose(this.app.run, Number(row.dataset.index), true);
    else if (go) {
      row.tabIndex = -1;
      go.tabIndex = 0;
      go.focus();
    } else return;
    event.preventDefault();
  }
}
