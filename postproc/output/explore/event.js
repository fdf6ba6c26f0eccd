// SPDX-License-Identifier: GPL-2.0-or-later
// One event: its numbers, its slip velocity in space and time with wave speeds, and its slip.
'use strict';

const columnNames = {
  event_id: ['Event', ''], t_start: ['Begins', 'time'], t_end: ['Ends', 'time'], duration: ['Duration', 'time'],
  size: ['Size', 'energy'], pe_start: ['PE before', 'energy'], pe_end: ['PE after', 'energy'],
  step_start: ['First step', ''], step_end: ['Last step', ''],
  slip_moment: ['Slip moment', ''], x_centroid: ['Centre', 'place'], rupture_length: ['Length', 'length'],
  x_hypocentre: ['First place', 'place'], x_begin: ['From', 'place'], mean_slip: ['Mean slip', 'length'],
  stress_drop: ['Stress drop', 'stress'], peak_slip: ['Largest slip', 'length'],
  moment_strike: ['Moment along strike', ''], moment_dip: ['Moment along dip', ''], rupture_width: ['Width along dip', 'length'],
  rupture_area: ['Area', 'area'], z_centroid: ['Centre, z', 'place'], z_hypocentre: ['First place, z', 'place'], z_begin: ['From, z', 'place'],
  peak_slip_rate: ['Largest slip rate', 'velocity'],
  source_duration: ['Duration of 5 to 95 % of the moment', 'time'], peak_moment_rate: ['Largest moment rate', ''], centroid_time: ['Centroid time', 'time'],
  stress_work: ['Work of stress', 'energy'], friction_work: ['Work of friction', 'energy'], contact_energy: ['Stored by contacts', 'energy'],
  radiated_energy: ['Radiated energy', 'energy'], apparent_stress: ['Apparent stress', 'stress'], fracture_energy: ['Fracture energy', 'energy'],
  weighted_stress_drop: ['Stress drop by slip', 'stress'], corner_frequency: ['Corner frequency', '1 / time']
};

class EventPanel {
  constructor(app) {
    this.app = app;
    this.find = id => document.getElementById(id);
    this.find('zoom-event').addEventListener('click', () => app.zoomToEvent());
    this.find('slip-map').addEventListener('pointermove', event => this.readSlip(event));
    new ResizeObserver(oncePerFrame(() => this.drawSlip())).observe(this.find('event-numbers'));
  }

  show(run, index) {
    const events = this.app.eventsOf(run), rank = events.bySize.indexOf(index) + 1;
    this.run = run;
    this.index = index;
    this.find('event-head').textContent =
      `${events.info.kind === 'ruptures' ? 'Rupture' : 'Event'} ${events.columns.event_id[index]}` +
      (this.app.runs.length > 1 ? ` of ${run.info.label}` : '');
    this.find('event-place').textContent = rank === 1
      ? `the largest of ${events.info.count}` : `number ${rank} of ${events.info.count} by size`;
    const list = this.find('event-numbers');
    list.replaceChildren();
    for (const name of Object.keys(columnNames)) {
      if (name === 'event_id' || (name !== 'duration' && !events.has(name))) continue;
      const [label, unit] = columnNames[name], value = events.get(name, index);
      const pair = element('div');
      pair.append(element('dt', label, {title: unit ? `${name}, ${unit}` : name}),
        element('dd', name.startsWith('step') ? String(value) : short(value, 8), {'data-column': name, 'data-value': String(value)}));
      list.append(pair);
    }
    this.showOthers(events);
    this.drawSlip();
  }

  /** The width of pictures of the event. */
  get width() { return Math.min(640, this.find('event-numbers').clientWidth || 480); }

  /** Ruptures within a drop of PE, or the drop of PE that a rupture is part of. */
  showOthers(events) {
    const place = this.find('event-others');
    place.replaceChildren();
    const other = this.run.kinds.find(kind => kind !== events);
    if (!other) return;
    const found = other.between(events.columns.t_start[this.index], events.columns.t_end[this.index]);
    found.sort((a, b) => other.columns.size[b] - other.columns.size[a]);
    const ruptures = other.info.kind === 'ruptures';
    place.append(found.length === 0 ? (ruptures ? 'No rupture at that time.' : 'In no drop of PE.')
      : `${ruptures ? 'Ruptures' : 'Drops of PE'} at that time: `);
    found.slice(0, 8).forEach(i => {
      const button = element('button', String(other.columns.event_id[i]), {type: 'button', class: 'link'});
      button.addEventListener('click', () => this.app.chooseOther(this.run, other, i));
      place.append(button, ' ');
    });
    if (found.length > 8) place.append(`and ${found.length - 8} smaller ones`);
    this.others = {ruptures: ruptures ? other : null, found};
  }

  /** Where an event began, as far as is known; the middle of the picture. */
  origin(events) {
    if (events.has('x_hypocentre')) return events.columns.x_hypocentre[this.index];
    const {ruptures, found} = this.others || {};
    if (ruptures && found.length) return ruptures.columns.x_hypocentre[found[0]];
    const slip = this.run.slip, sums = slip.slipBetween(events.columns.t_start[this.index], events.columns.t_end[this.index]);
    return slip.info.x0 + (sums.indexOf(Math.max(...sums)) + 0.5) * slip.info.columnWidth;
  }

  drawSlip() {
    const figure = this.find('event-slip'), slip = this.run && this.run.slip;
    if (!slip) { figure.hidden = true; return; }
    const events = this.app.eventsOf(this.run), begin = events.columns.t_start[this.index], end = events.columns.t_end[this.index];
    const row = slip.rowAt(begin);
    const inside = row >= 0 && row < slip.ends.length;
    figure.hidden = !inside;
    if (!inside) return;
    const width = this.width;
    const origin = this.origin(events), n = slip.columns, info = slip.info;
    // The place where it began in the middle: the fault is periodic.
    const shift = ((slip.columnAt(origin) - (n >> 1)) % n + n) % n;
    const x0 = -((n >> 1) + 0.5) * info.columnWidth, x1 = x0 + info.length;
    const least = 4 * (slip.ends[row] - slip.rowBegin(row));
    const span = Math.max(end - begin, least), from = begin - 0.15 * span, to = begin + 1.15 * span;

    const canvas = this.find('slip-map'), context = sharp(canvas, width, 338);
    const frame = {x: 62, y: 32, w: width - 80, h: 262}, pixels = 300; // below the scale
    const shades = slip.shadesOver(from, to, pixels), turned = new Uint8Array(shades.length);
    for (let p = 0; p < pixels; ++p)
      for (let c = 0; c < n; ++c) turned[p * n + c] = shades[p * n + (c + shift) % n];
    drawShades(context, turned, pixels, n, frame, true);
    const x = place => frame.x + (place - x0) / (x1 - x0) * frame.w;
    const y = time => frame.y + frame.h - (time - from) / (to - from) * frame.h;
    this.drawWaves(context, frame, x, y, x0, x1, begin, to);
    if (events.has('x_begin')) this.drawOutline(context, events, x, y, origin, begin, end, info);
    else {
      context.strokeStyle = chosenColour;
      context.setLineDash([5, 3]);
      for (const time of [begin, end]) drawLine(context, frame.x, y(time), frame.x + frame.w, y(time));
      context.setLineDash([]);
    }
    drawAxes(context, frame, {from: x0, to: x1, title: 'Distance from its first place along the fault'},
      {from: from - begin, to: to - begin, title: 'Time since it began'});
    drawSlipScale(context, frame.x + frame.w - 120, 2, 110);
    this.map = {frame, x0, x1, from, to, begin, origin};
    this.drawProfile(slip.slipBetween(begin, end), shift, x0, x1, frame, width);
    canvas.setAttribute('aria-label', `Slip velocity in space and time during event ${events.columns.event_id[this.index]}`);
    this.find('slip-caption').textContent =
      `Slip velocity over the driving velocity (${short(info.driving)}), ${events.has('x_begin') ? 'outlined: length and duration of the rupture' : 'dashed: begin and end of the event'}; ` +
      `lines: P-waves (speed ${short(this.app.page.pSpeed)}) and, dashed, S-waves (${short(this.app.page.sSpeed)}) from its first place. Below: its slip.` +
      (info.binsPerColumn > 1 || info.recordsPerRow > 1 ? ` Each cell is the mean of ${info.binsPerColumn} bins and ${info.recordsPerRow} records.` : '');
  }

  drawWaves(context, frame, x, y, x0, x1, begin, to) {
    context.save();
    context.beginPath();
    context.rect(frame.x, frame.y, frame.w, frame.h);
    context.clip();
    context.lineWidth = 1.5;
    for (const [speed, dash, colour, name] of [[this.app.page.pSpeed, [], '#000', 'P'], [this.app.page.sSpeed, [7, 4], '#0072B2', 'S']]) {
      const reach = Math.min(x1, -x0, (to - begin) * speed);
      context.strokeStyle = context.fillStyle = colour;
      context.setLineDash(dash);
      context.beginPath();
      context.moveTo(x(-reach), y(begin + reach / speed));
      context.lineTo(x(0), y(begin));
      context.lineTo(x(reach), y(begin + reach / speed));
      context.stroke();
      context.textAlign = 'center';
      context.textBaseline = 'bottom';
      context.font = 'bold 13px system-ui, sans-serif';
      context.fillText(name, x(reach * 0.85), y(begin + 0.85 * reach / speed) - 4);
    }
    context.restore();
  }

  drawOutline(context, events, x, y, origin, begin, end, info) {
    const length = events.columns.rupture_length[this.index];
    if (length >= info.length * (1 - 1e-9)) return;
    let from = (events.columns.x_begin[this.index] - origin) % info.length;
    if (from > 0.5 * info.columnWidth) from -= info.length;
    if (from < -info.length / 2 - length) from += info.length;
    context.strokeStyle = chosenColour;
    context.setLineDash([5, 3]);
    context.strokeRect(x(from), y(end), x(from + length) - x(from), y(begin) - y(end));
    context.setLineDash([]);
  }

  drawProfile(slips, shift, x0, x1, frame, width) {
    const canvas = this.find('slip-profile'), shifted = slips.map((_, c) => slips[(c + shift) % slips.length]);
    const most = drawSteps(sharp(canvas, width, 140), shifted, {x: frame.x, y: 8, w: frame.w, h: 90},
      {from: x0, to: x1, title: 'Distance from its first place along the fault'}, 'Slip');
    canvas.setAttribute('aria-label', `Slip along the fault, at most ${short(most, 4)}`);
    canvas.dataset.most = String(most);
  }

  readSlip(event) {
    const {frame, x0, x1, from, to, begin, origin} = this.map;
    const under = this.run.slip.under(event, frame, (u, v) => {
      const x = x0 + u * (x1 - x0);
      return {time: from + v * (to - from), x, place: origin + x};
    });
    const since = under && under.time - begin;
    this.find('slip-readout').textContent = !under ? '' :
      `distance ${short(under.x, 4)}, time ${short(since, 4)}: slip velocity ${under.velocity} of the driving velocity` +
      (since > 0 ? `; from its first place at speed ${short(Math.abs(under.x) / since, 3)}` : '');
  }
}
