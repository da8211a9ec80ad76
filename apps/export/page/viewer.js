// The model, to be turned with the mouse.
(function () {
  'use strict';
  const model = JSON.parse(document.getElementById('model').textContent);
  const place = document.getElementById('viewer');
  const KINDS = ['wall', 'roof', 'ground', 'ceiling'];

  // Red where there is nothing over yellow to green.
  const RAMP = [0xc0453a, 0xe8c860, 0x4f9a5b].map(colour => new THREE.Color(colour));
  function ramp(share) {
    const s = 2 * Math.min(1, Math.max(0, share));
    return s < 1 ? RAMP[0].clone().lerp(RAMP[1], s) : RAMP[1].clone().lerp(RAMP[2], s - 1);
  }

  const largestResidual = Math.max(1e-300, ...model.faces.map(face => face.residual));
  const colouring = {
    kind: face => new THREE.Color(...model.colours[face.material]),
    coverage: face => ramp(face.coverage),
    residual: face => face.support > 0 ? ramp(1 - face.residual / largestResidual)
                                       : new THREE.Color(0.7, 0.7, 0.7),
  };

  // Corners are not shared: faces meet at edges, not in round shading.
  function makeSurface() {
    const positions = [];
    const faceOfTriangle = [];
    model.faces.forEach((face, index) => face.triangles.forEach((corner, i) => {
      positions.push(...model.vertices.slice(3 * corner, 3 * corner + 3));
      if (i % 3 === 0) faceOfTriangle.push(index);
    }));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    geometry.setAttribute('color',
                          new THREE.Float32BufferAttribute(new Float32Array(positions.length), 3));
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial({
      vertexColors: THREE.VertexColors, polygonOffset: true, polygonOffsetFactor: 1,
      polygonOffsetUnits: 1});
    return {mesh: new THREE.Mesh(geometry, material), faceOfTriangle};
  }

  function makeEdges() {
    const positions = [];
    model.faces.forEach(face => face.rings.forEach(ring => ring.forEach((corner, i) => {
      const next = ring[(i + 1) % ring.length];
      if (corner > next) return;  // the neighbour draws it
      positions.push(...model.vertices.slice(3 * corner, 3 * corner + 3),
                     ...model.vertices.slice(3 * next, 3 * next + 3));
    })));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: 0x23272b}));
  }

  function paint(surface, mode) {
    const colours = surface.mesh.geometry.attributes.color;
    surface.faceOfTriangle.forEach((index, triangle) => {
      const colour = colouring[mode](model.faces[index]);
      for (let i = 0; i < 3; ++i) colours.setXYZ(3 * triangle + i, colour.r, colour.g, colour.b);
    });
    colours.needsUpdate = true;
  }

  function describeColours(mode) {
    const legend = document.getElementById('legend');
    legend.textContent = '';
    const add = (colour, text) => {
      const swatch = document.createElement('span');
      swatch.className = 'swatch';
      swatch.style.background = '#' + colour.getHexString();
      legend.append(swatch, text);
    };
    if (mode === 'kind') {
      KINDS.forEach((kind, label) => add(new THREE.Color(...model.colours[label]), kind));
      legend.append(' \u2013 paler where it is guessed');
    } else if (mode === 'coverage') {
      [0, 0.5, 1].forEach(share => add(ramp(share), 100 * share + ' %'));
    } else {
      [0, 0.5, 1].forEach(share => add(ramp(1 - share),
                                       (share * largestResidual).toPrecision(2)));
    }
  }

  function start() {
    const up = new THREE.Vector3(...model.up);
    const surface = makeSurface();
    const radius = (surface.mesh.geometry.computeBoundingSphere(),
                    surface.mesh.geometry.boundingSphere.radius);
    const scene = new THREE.Scene();
    scene.add(surface.mesh, makeEdges());
    const choice = document.getElementById('colours');
    const recolour = () => { paint(surface, choice.value); describeColours(choice.value); };
    recolour();
    const {camera, canvas, render} = turntable(place, scene, up, radius);
    choice.addEventListener('change', () => { recolour(); render(); });
    pickWithClicks(canvas, camera, surface);
  }

  // A click, not the end of a turn.
  function pickWithClicks(canvas, camera, surface) {
    let pressed = null;
    canvas.addEventListener('mousedown', event => { pressed = [event.clientX, event.clientY]; });
    canvas.addEventListener('mouseup', event => {
      if (pressed === null ||
          Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 3) return;
      const box = canvas.getBoundingClientRect();
      const ray = new THREE.Raycaster();
      ray.setFromCamera({x: 2 * (event.clientX - box.left) / box.width - 1,
                         y: 1 - 2 * (event.clientY - box.top) / box.height}, camera);
      const hit = ray.intersectObject(surface.mesh)[0];
      if (!hit) return;
      const index = surface.faceOfTriangle[Math.floor(hit.faceIndex)];
      const face = model.faces[index];
      document.getElementById('picked').textContent =
          `Face ${index}: ${KINDS[face.label]}${face.wall >= 0 ? ' ' + face.wall : ''}` +
          `${face.hypothetical ? ', guessed' : ''}, area ${face.area.toPrecision(4)}, ` +
          `${face.support} points on ${(100 * face.coverage).toFixed(0)} % of it, ` +
          `distance ${face.residual.toPrecision(3)}, deviation ` +
          (face.deviation === null ? 'not known' : face.deviation.toPrecision(3));
    });
  }

  try {
    start();
  } catch (error) {
    cannotDraw(place, error);
  }
})();
