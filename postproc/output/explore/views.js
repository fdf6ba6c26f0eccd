// SPDX-License-Identifier: GPL-2.0-or-later
// The pictures of a run over time: PE, the sizes of its events, and where the fault slips, all of
// them over the same times.
'use strict';

class View {
  static labelWidth = 70;

  /** @param app the selection, and what to call when it changes */
  constructor(run, number, parent, app) {
    this.run = run;
    this.number = number;
    this.app = app;
    const events = run.kinds[0].columns;
    this.begin = run.series ? run.series.begin : events.t_start[0];
    this.end = run.series ? run.series.end : events.t_end[events.t_end.length - 1];
    if (!(this.end > this.begin)) this.end = this.begin + 1;
    this.window = [this.begin, this.end];
    this.refreshSoon = oncePerFrame(() => this.refresh());

    this.box = element('div', undefined, {class: 'view', 'data-run': String(number)});
    if (app.runs.length > 1) this.box.append(element('h3', run.info.label));
    this.frame = element('div', undefined, {
      class: 'graphs', tabindex: '0', role: 'group',
      'aria-label': 'Pictures over time. Arrows move, plus and minus zoom, 0 shows the whole run, n and p choose the next and the previous event.'
    });
    this.peBox = element('div', undefined, {class: 'pe'});
    this.sizeBox = element('div', undefined, {class: 'event-sizes'});
    this.slipBox = element('canvas', undefined, {class: 'slip', role: 'img'});
    this.readout = element('p', ' ', {class: 'readout'});
    if (run.series) this.frame.append(this.peBox);
    this.frame.append(this.sizeBox);
    if (run.slip) this.frame.append(this.slipBox);
    this.box.append(this.frame, this.readout);
    parent.append(this.box);
    this.listen();
    this.makeGraphs();
    this.refresh();
  }

  get events() { return this.app.eventsOf(this.run); }

  makeGraphs() {
    const common = {
      legend: 'never', labelsKMB: false, digitsAfterDecimal: 6, panEdgeFraction: 0.001, connectSeparatedPoints: true,
      xRangePad: 0, gridLineColor: '#ddd', axisLineColor: '#555', highlightCircleSize: 3,
      dateWindow: this.window.slice(),
      // With a range selector a drag would move, not zoom.
      interactionModel: Dygraph.defaultInteractionModel,
      drawCallback: graph => this.follow(graph),
      clickCallback: (event, x) => this.click(event),
      zoomCallback: () => this.refreshSoon()
    };
    const selector = {showRangeSelector: true, rangeSelectorHeight: 36, rangeSelectorPlotFillColor: '', rangeSelectorPlotStrokeColor: '#0072B2'};
    const axes = {
      x: {axisLabelFormatter: x => short(x, 9), valueFormatter: x => short(x, 9), pixelsPerLabel: 90},
      y: {axisLabelWidth: View.labelWidth, axisLabelFormatter: y => short(y, 6)}
    };
    this.graphs = [];
    if (this.run.series) {
      this.overview = this.run.series.points(this.begin, this.end, 400);
      this.peGraph = new Dygraph(this.peBox, this.peData(), {
        ...common, ...selector, axes, labels: ['time', 'PE'], colors: ['#00507d'], strokeWidth: 1.4,
        ylabel: 'Potential energy', valueRange: this.peRange(),
        underlayCallback: (context, area, graph) => this.shade(context, area, graph),
        highlightCallback: (event, x) => this.follow_mouse(x),
        unhighlightCallback: () => this.say(' ')
      });
      this.graphs.push(this.peGraph);
    }
    this.sizeGraph = new Dygraph(this.sizeBox, this.sizeData(), {
      ...common, ...(this.run.series ? {} : selector), labels: ['time', 'size'], colors: ['#0072B2'], highlightCircleSize: 0,
      axes: {x: axes.x, y: {...axes.y, logscale: true, ticker: logTicks, pixelsPerLabel: 12}},
      ylabel: 'Size of events', xlabel: this.run.slip ? '' : `Time (${unitsOf(this.run).time})`, valueRange: this.sizeRange(),
      plotter: e => this.plotSizes(e),
      underlayCallback: (context, area, graph) => this.markThreshold(context, area, graph)
    });
    this.graphs.push(this.sizeGraph);
  }

  /** The samples of the window in full, the rest of the run coarsely, for the range selector. */
  peData() {
    const [from, to] = this.window, series = this.run.series;
    const pixels = this.peGraph ? this.peGraph.getArea().w : 900;
    const inside = series.points(from, to, Math.max(100, Math.round(pixels)));
    const first = inside.length ? inside[0][0] : from, last = inside.length ? inside[inside.length - 1][0] : to;
    const data = this.overview.filter(p => p[0] < first).concat(inside, this.overview.filter(p => p[0] > last));
    this.everySample = series.index(to) - series.index(from) < 150;
    return data;
  }

  peRange() {
    const [from, to] = this.window, series = this.run.series;
    let [low, high] = series.extremes(series.index(from) - 1, series.index(to) + 1);
    if (!(high > low)) { high = low + Math.max(1e-12, Math.abs(low) * 1e-9); }
    const room = 0.04 * (high - low);
    return [low - room, high + room];
  }

  /** Sizes of the events of the window; where several share a pixel, the largest. */
  sizeData() {
    const [from, to] = this.window, events = this.events, pixels = 1200;
    const {t_start, size} = events.columns;
    const best = new Map();
    const rest = this.run.series ? [] : events.bySize.subarray(0, 500);
    const inside = events.between(from, to);
    const add = (i, column) => {
      if (!(size[i] > 0)) return;
      const other = best.get(column);
      if (other === undefined || size[other] < size[i]) best.set(column, i);
    };
    for (const i of inside) add(i, inside.length > 2 * pixels ? Math.floor((t_start[i] - from) / (to - from) * pixels) : `event ${i}`);
    for (const i of rest) add(i, `event ${i}`);
    const data = [...new Set(best.values())].map(i => [t_start[i], size[i]]);
    data.push([this.begin, null], [this.end, null]);
    return data.sort((a, b) => a[0] - b[0]);
  }

  sizeRange() {
    const events = this.events, size = events.columns.size, order = events.bySize;
    let last = order.length - 1;
    while (last > 0 && !(size[order[last]] > 0)) --last;
    const most = size[order[0]];
    // More than eight decades are of no use, and the smallest events are of rounding.
    const least = Math.max(size[order[last]], most * 1e-8);
    return most > 0 ? [least / 2, most * 2] : [0.1, 1];
  }

  /** Shows the times that another picture of the run, or its range selector, went to. */
  follow(graph) {
    const [from, to] = graph.xAxisRange();
    if (from === this.window[0] && to === this.window[1]) return;
    this.window = this.within(from, to);
    this.refreshSoon();
  }

  /** The window within the run, no shorter than two samples. */
  within(from, to) {
    const least = this.run.series ? 2 * this.run.series.info.spacing : (this.end - this.begin) * 1e-9;
    if (to - from < least) [from, to] = [(from + to - least) / 2, (from + to + least) / 2];
    const span = Math.min(to - from, this.end - this.begin);
    if (from < this.begin) return [this.begin, this.begin + span];
    if (to > this.end) return [this.end - span, this.end];
    return [from, from + span];
  }

  show(from, to) {
    this.window = this.within(from, to);
    this.refreshSoon();
  }

  refresh() {
    const dateWindow = this.window.slice();
    if (this.peGraph)
      this.peGraph.updateOptions({file: this.peData(), dateWindow, valueRange: this.peRange(), drawPoints: this.everySample, pointSize: 2});
    this.sizeGraph.updateOptions({file: this.sizeData(), dateWindow, valueRange: this.sizeRange()});
    if (this.run.slip) this.drawSlip();
    this.app.windowChanged(this);
  }

  /** Event boxes behind the curve: all of them where there is room, else those above the threshold. */
  shade(context, area, graph) {
    const [from, to] = graph.xAxisRange(), events = this.events, {t_start, t_end, size} = events.columns;
    const found = events.between(from, to), crowded = found.length > area.w / 4;
    const x = time => Math.min(Math.max(graph.toDomXCoord(time), area.x), area.x + area.w);
    context.save();
    context.fillStyle = eventColour;
    let drawn = -1;
    for (const i of found) {
      if (crowded && size[i] < this.app.threshold) continue;
      const left = x(t_start[i]), right = Math.max(x(t_end[i]), left + 1);
      if (right <= drawn + 0.5) continue;
      context.fillRect(left, area.y, right - left, area.h);
      drawn = right;
    }
    const chosen = this.app.chosenIn(this.run);
    if (chosen !== null && t_end[chosen] >= from && t_start[chosen] <= to) {
      const left = x(t_start[chosen]), right = Math.max(x(t_end[chosen]), left + 1.5);
      context.fillStyle = chosenShade;
      context.fillRect(left, area.y, right - left, area.h);
      context.fillStyle = chosenColour;
      context.fillRect(left - 0.5, area.y, 1.5, area.h);
      const middle = (left + right) / 2;
      drawMark(context, 'triangle', middle, area.y + 6, 5);
    }
    context.restore();
  }

  plotSizes(e) {
    const context = e.drawingContext, chosen = this.app.chosenIn(this.run), {t_start, size} = this.events.columns;
    const bottom = e.plotArea.y + e.plotArea.h;
    context.save();
    for (const point of e.points) {
      if (point.yval === null || !(point.yval > 0)) continue;
      const isChosen = chosen !== null && point.xval === t_start[chosen] && point.yval === size[chosen];
      context.fillStyle = context.strokeStyle = isChosen ? chosenColour : point.yval >= this.app.threshold ? '#0072B2' : '#aaa';
      context.lineWidth = isChosen ? 2 : 0.6;
      drawLine(context, point.canvasx, bottom, point.canvasx, point.canvasy);
      drawMark(context, isChosen ? 'triangle' : 'circle', point.canvasx, point.canvasy, isChosen ? 5 : 1.8);
    }
    context.restore();
  }

  markThreshold(context, area, graph) {
    const y = graph.toDomYCoord(this.app.threshold);
    if (!(y >= area.y && y <= area.y + area.h)) return;
    context.save();
    context.strokeStyle = '#333';
    context.setLineDash([6, 4]);
    drawLine(context, area.x, y, area.x + area.w, y);
    context.restore();
  }

  drawSlip() {
    const slip = this.run.slip, area = this.sizeGraph.getArea();
    // The scale stands beside the title of the axis, or, where there is no room, below it.
    const width = this.frame.clientWidth, scaleRow = width < 900 ? 26 : 0, height = 190 + scaleRow;
    const context = sharp(this.slipBox, width, height);
    const frame = {x: area.x, y: 6, w: area.w, h: 142};
    this.slipFrame = frame;
    const [from, to] = this.window, pixels = Math.max(1, Math.round(frame.w));
    drawShades(context, slip.shadesOver(from, to, pixels), pixels, slip.columns, frame, false);
    const chosen = this.app.chosenIn(this.run), events = this.events;
    if (chosen !== null) {
      const x = time => Math.min(Math.max(frame.x + (time - from) / (to - from) * frame.w, frame.x), frame.x + frame.w);
      const left = x(events.columns.t_start[chosen]), right = x(events.columns.t_end[chosen]);
      context.strokeStyle = chosenColour;
      context.lineWidth = 1.5;
      if (right > frame.x && left < frame.x + frame.w) context.strokeRect(left, frame.y, Math.max(right - left, 1), frame.h);
    }
    drawAxes(context, frame, {from, to, title: 'Time (model units)'}, {from: slip.info.x0, to: slip.info.x0 + slip.info.length, title: 'Place'});
    drawSlipScale(context, frame.x + 8, height - 24, 120);
    context.textAlign = 'left';
    context.fillText(width < 500 ? 'slip / driving velocity' : 'slip velocity / driving velocity', frame.x + 160, height - 19);
    this.slipBox.setAttribute('aria-label', `Slip velocity along the fault from time ${short(from)} to ${short(to)}`);
  }

  listen() {
    this.frame.addEventListener('keydown', event => this.key(event));
    this.frame.addEventListener('pointerdown', () => this.app.activate(this));
    this.slipBox.addEventListener('pointermove', event => {
      const under = this.slipUnder(event);
      this.say(under ? `time ${short(under.time, 9)}, place ${short(under.x, 4)}: slip velocity ${under.velocity} of the driving velocity` : ' ');
    });
    this.slipBox.addEventListener('click', event => {
      const under = this.slipUnder(event);
      if (under) this.chooseAt(under.time);
    });
    new ResizeObserver(() => { if (this.sizeGraph) this.refreshSoon(); }).observe(this.box);
  }

  slipUnder(event) {
    const [from, to] = this.window, {x0, length} = this.run.slip.info;
    return this.run.slip.under(event, this.slipFrame, (u, v) => ({time: from + u * (to - from), x: x0 + v * length}));
  }

  key(event) {
    const [from, to] = this.window, span = to - from, middle = (from + to) / 2;
    const keys = {
      ArrowLeft: () => this.show(from - span / 5, to - span / 5),
      ArrowRight: () => this.show(from + span / 5, to + span / 5),
      '+': () => this.show(middle - span / 4, middle + span / 4),
      '=': () => this.show(middle - span / 4, middle + span / 4),
      '-': () => this.show(middle - span, middle + span),
      0: () => this.show(this.begin, this.end),
      Home: () => this.show(this.begin, this.end),
      n: () => this.app.step(1),
      p: () => this.app.step(-1)
    };
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.app.activate(this);
    keys[event.key]();
  }

  click(event) {
    const graph = this.graphs.find(g => g.graphDiv.contains(event.target)) || this.graphs[0];
    this.chooseAt(graph.toDataXCoord(graph.eventToDomCoords(event)[0]));
  }

  /** The largest event within three pixels of a time. */
  chooseAt(time) {
    const room = 3 * (this.window[1] - this.window[0]) / Math.max(1, this.sizeGraph.getArea().w);
    const size = this.events.columns.size, found = this.events.between(time - room, time + room);
    if (found.length === 0) return;
    this.app.choose(this.run, found.reduce((best, i) => size[i] > size[best] ? i : best));
  }

  follow_mouse(time) {
    const series = this.run.series, i = Math.min(series.index(time), series.length - 1), step = series.step(i);
    const inside = this.events.between(series.time(i), series.time(i));
    const names = inside.slice(0, 3).map(k => this.events.columns.event_id[k]).join(', ');
    this.say(`time ${short(series.time(i), 10)}${step === null ? '' : `, step ${step}`}: PE ${short(series.values[i], 10)}` +
      (inside.length ? `; event ${names}${inside.length > 3 ? ' …' : ''}` : ''));
  }

  say(text) { this.readout.textContent = text; }
}
