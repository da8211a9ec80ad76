// What report.json says, as tables and charts.
(function () {
  'use strict';
  const report = JSON.parse(document.getElementById('report').textContent);
  const model = JSON.parse(document.getElementById('model').textContent);
  const byId = id => document.getElementById(id);
  const number = (value, digits = 4) => value === null || value === undefined ? '\u2013'
      : Number(Number(value).toPrecision(digits)).toLocaleString('en', {maximumFractionDigits: 12});
  const percent = share => share === null ? '\u2013' : (100 * share).toFixed(1) + ' %';

  function element(tag, text, className) {
    const made = document.createElement(tag);
    if (text !== undefined) made.textContent = text;
    if (className) made.className = className;
    return made;
  }

  // Columns whose heading starts with '<' hold text.
  function table(place, headings, rows) {
    const made = element('table');
    const addRow = (cells, tag) => {
      const row = element('tr');
      cells.forEach((cell, i) => row.append(
          element(tag, cell, headings[i].startsWith('<') ? 'text' : '')));
      made.append(row);
    };
    addRow(headings.map(heading => heading.replace('<', '')), 'th');
    rows.forEach(row => addRow(row, 'td'));
    place.append(made);
  }

  function svg(tag, attributes, text) {
    const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    if (text !== undefined) made.textContent = text;
    return made;
  }

  // How many there are; of a sample, of how many.
  function pointsRead() {
    const {points, declared, thinned_out} = report.input;
    return thinned_out > 0 ? `${points} of ${declared} points` : `${points} points`;
  }

  function head() {
    const state = report.model.valid ? 'closed and valid' : 'NOT VALID';
    byId('title').textContent = report.input.file.split('/').pop();
    byId('summary').textContent =
        `${pointsRead()} to ${report.model.polygons} polygons, ${state}; ` +
        `volume ${number(report.model.volume)}, noise ${number(report.scale.noise, 3)}. ` +
        `Lengths are in the cloud\u2019s unit. Made by ${report.program}.`;
    byId('summary').className = report.model.valid ? '' : 'bad';
  }

  const found = {
    read: () => `${pointsRead()}, ${report.input.format}`,
    normals: () => report.normals.estimated
        ? `estimated from ${report.normals.neighbors} neighbours` : 'given',
    vertical: () => `deviation ${number(report.vertical.deviation_deg, 3)} degrees, ` +
        `${percent(report.vertical.wall_share)} of the normals are level`,
    orientation: () => `seen from ${report.space.side} (${report.space.reason})`,
    scale: () => `noise ${number(report.scale.noise, 3)}, ` +
        `spacing ${number(report.scale.spacing, 3)}, extent ${number(report.scale.extent)}`,
    planar: () => `${report.planar.points} points kept`,
    directions: () => `${report.directions.length} dominant directions`,
    floorplans: () => report.slices.count > 0
        ? `${report.slices.with_floorplan} of ${report.slices.count} slices`
        : `${report.building.wall_lines.length} walls, ${report.building.cells} cells, ` +
          `${report.building.layers} layers`,
    model: () => `${report.model.walls} walls, ${report.model.roofs} roofs, ` +
        `${report.model.grounds} ground, ${report.model.ceilings} ceilings` +
        (report.input.thinned_out > 0
            ? `, fitted to ${report.input.fitted_to_all ? 'all points' : 'the sample alone'}` : ''),
  };

  function stages() {
    const rows = Object.entries(report.seconds).filter(([name]) => name !== 'total')
        .map(([name, seconds]) => [name, found[name] ? found[name]() : '', seconds.toFixed(2)]);
    rows.push(['total', `${report.peak_megabytes.toFixed(0)} MB at most`,
               report.seconds.total.toFixed(2)]);
    table(byId('stages'), ['<stage', '<found', 'seconds'], rows);
  }

  function storeys() {
    table(byId('storeys'), ['storey', 'from', 'to', 'parts', 'walls', 'area'],
          report.layers.blocks.map((block, k) => [k, number(block.z_min), number(block.z_max),
              block.components, block.edges, number(block.area)]));
    byId('storeys').append(element('p', `${report.layers.types} types of floorplan; heights along ` +
        'the vertical of the cloud\u2019s frame', 'note'));
    table(byId('levels'), ['height', 'points of walls', 'of level faces', 'deviation'],
          report.levels.map(level => [number(level.z, 5), level.wall_points, level.cap_points,
                                      number(level.deviation, 3)]));
  }

  const WIDTH = 620, HEIGHT = 220, LEFT = 60, BOTTOM = 30;

  // An empty chart with axes; x and y go from 0 to their largest.
  function chart(place, largestX, largestY, titleX, titleY) {
    const made = svg('svg', {class: 'chart', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, width: WIDTH,
                             height: HEIGHT});
    const x = value => LEFT + (WIDTH - LEFT - 20) * value / largestX;
    const y = value => HEIGHT - BOTTOM - (HEIGHT - BOTTOM - 24) * value / largestY;
    made.append(svg('path', {d: `M${LEFT} 20V${y(0)}H${WIDTH - 20}`, fill: 'none', stroke: '#888'}),
                svg('text', {x: WIDTH - 20, y: HEIGHT - 4, 'text-anchor': 'end'}, titleX),
                svg('text', {x: 4, y: 12}, titleY),
                svg('text', {x: LEFT - 6, y: y(largestY) + 4, 'text-anchor': 'end'},
                    number(largestY, 3)));
    for (let i = 0; i <= 4; ++i) {
      const value = largestX * i / 4;
      made.append(svg('text', {x: x(value), y: y(0) + 14, 'text-anchor': 'middle'},
                      number(value, 3)));
    }
    place.append(made);
    return {made, x, y};
  }

  // Fit against size, only when it was asked for: else there is but the model itself.
  function tradeOff() {
    const whole = report.building.trade_off;
    const paper = report.layers.trade_off;
    const points = whole.length > 1
        ? whole.map(point => ({size: point.faces, energy: point.energy}))
        : paper.map(point => ({size: point.types, energy: point.energy}));
    if (points.length < 2) return;
    const name = whole.length > 1 ? 'polygons' : 'types';
    byId('trade_off').hidden = false;
    const best = Math.min(...points.map(point => point.energy));
    const left = points.map(point => point.energy - best);
    const {made, x, y} = chart(byId('trade_off'), Math.max(...points.map(point => point.size)),
                               Math.max(...left), name, 'left unexplained');
    const path = points.map((point, i) => `${i ? 'L' : 'M'}${x(point.size)} ${y(left[i])}`);
    made.append(svg('path', {d: path.join(''), fill: 'none', stroke: '#2c6fad'}));
    points.forEach((point, i) => made.append(
        svg('circle', {cx: x(point.size), cy: y(left[i]), r: 4, fill: '#2c6fad'})));
    table(byId('trade_off'), [name, 'left unexplained'],
          points.map((point, i) => [point.size, number(left[i])]));
  }

  function residuals() {
    const {bin, counts, beyond, points} = report.residuals;
    const place = byId('residuals');
    const {made, x, y} = chart(place, bin * counts.length, Math.max(1, ...counts),
                               'distance to the model', 'points');
    counts.forEach((count, i) => made.append(svg('rect', {
      x: x(i * bin), width: x(bin) - x(0) - 1, y: y(count), height: y(0) - y(count),
      fill: '#2c6fad'})));
    place.append(element('p', `${points} points, of which ${beyond} (${
        percent(points > 0 ? beyond / points : null)}) lie further off`, 'note'));
  }

  // A row for each wall: of its faces together, and what the fit says of its plane.
  function walls() {
    const rows = report.walls.map(wall => {
      const faces = model.faces.filter(face => face.wall === wall.wall);
      const area = faces.reduce((sum, face) => sum + face.area, 0);
      const seen = faces.reduce((sum, face) => sum + face.area * face.coverage, 0);
      return {id: wall.wall, area, seen: area > 0 ? seen / area : null,
              guessed: faces.filter(face => face.hypothetical).length, wall};
    });
    rows.sort((a, b) => (a.seen === null ? 2 : a.seen) - (b.seen === null ? 2 : b.seen));
    table(byId('walls'), ['wall', 'azimuth', 'area', 'share seen', 'faces guessed', 'points',
                          'distance', 'deviation', 'of angle'],
          rows.map(({id, area, seen, guessed, wall}) => [
            id, number(Math.atan2(wall.normal[1], wall.normal[0]) * 180 / Math.PI, 5) + '\u00b0',
            number(area), percent(seen), guessed, wall.points, number(wall.residual, 3),
            number(wall.offset_deviation, 3),
            wall.angle_deviation_deg === null ? '\u2013'
                : number(wall.angle_deviation_deg, 2) + '\u00b0']));
    const {wall_share_seen: ofWalls, level_share_seen: ofLevels} = report.support;
    byId('walls').append(element('p', `All walls: ${percent(ofWalls)} seen; roofs, grounds and ` +
        `ceilings: ${percent(ofLevels)}`, 'note'));
  }

  head();
  stages();
  storeys();
  tradeOff();
  residuals();
  walls();
})();
