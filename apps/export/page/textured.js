// The textured model, to be turned with the mouse, and its facades at right angles, to measure in.
(function () {
  'use strict';
  const byId = id => document.getElementById(id);
  const facades = JSON.parse(byId('textured_facades').textContent);
  const place = byId('textured_viewer');

  // As it is in the photos: neither lit nor converted.
  function showAsPhotographed(model, images) {
    model.traverse(part => {
      if (!part.isMesh) return;
      const map = part.material.map;
      if (map) {
        map.encoding = THREE.LinearEncoding;
        images[Number(part.material.name.split('_')[1])] = map.image;
      } else {
        part.material.color.convertLinearToSRGB();
      }
      part.material.needsUpdate = true;
    });
  }

  // Where most of what the photos show looks to; undefined if that is to all sides.
  function photographedSide(model, up) {
    const sum = new THREE.Vector3();
    let area = 0;
    model.traverse(part => {
      if (!part.isMesh || !part.material.map) return;
      const corners = part.geometry.attributes.position;
      const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3());
      for (let i = 0; i < corners.count; i += 3) {
        [a, b, c].forEach((corner, k) => corner.fromBufferAttribute(corners, i + k));
        const normal = b.sub(a).cross(c.sub(a));
        area += normal.length();
        sum.add(normal);
      }
    });
    sum.addScaledVector(up, -sum.dot(up));
    return sum.length() > 0.2 * area ? sum.normalize() : undefined;
  }

  function show(gltf) {
    const model = gltf.scene.children[0];
    model.position.set(0, 0, 0);  // far from the origin, graphics cards are not exact
    const images = [];
    showAsPhotographed(model, images);
    facades.forEach(facade => showFacade(facade, images[facade.sheet]));
    const extent = new THREE.Box3().setFromObject(model).getSize(new THREE.Vector3()).length();
    const radius = 0.4 * extent;  // buildings do not fill the sphere about them
    try {
      const up = new THREE.Vector3(...model.userData.up);
      turntable(place, gltf.scene, up, radius, photographedSide(model, up));
    } catch (error) {
      cannotDraw(place, error);
    }
  }

  const number = value => Number(value.toPrecision(4)).toString();

  // 1, 2 or 5 times a power of ten, a quarter of the length at the most.
  function roundLength(length) {
    const power = 10 ** Math.floor(Math.log10(length / 4));
    return [5, 2, 1].map(factor => factor * power).find(round => round <= length / 4);
  }

  function showFacade(facade, image) {
    const canvas = document.createElement('canvas');
    canvas.width = facade.columns;
    canvas.height = facade.rows;
    const context = canvas.getContext('2d');
    const draw = () => context.drawImage(image, facade.left, facade.top, facade.columns,
                                         facade.rows, 0, 0, facade.columns, facade.rows);
    draw();
    const figure = document.createElement('figure');
    figure.className = 'facade';
    const scale = document.createElement('div');
    scale.className = 'scale';
    const caption = document.createElement('figcaption');
    figure.append(canvas, scale, caption);
    byId('facades').append(figure);
    const bar = roundLength(facade.width);
    const fit = () => {
      scale.style.width = canvas.clientWidth * bar / (facade.columns * facade.texel) + 'px';
    };
    fit();
    window.addEventListener('resize', fit);
    const about = `facade ${facade.facade}: ${number(facade.width)} wide, ` +
        `${number(facade.height)} high, ${(100 * facade.seen).toFixed(0)} % seen; ` +
        `bar ${number(bar)}, texel ${number(facade.texel)}`;
    caption.textContent = about;
    measureByDragging(canvas, context, draw, facade.texel,
                      length => { caption.textContent = `${about}; measured ${number(length)}`; });
  }

  function measureByDragging(canvas, context, draw, texel, tell) {
    let start = null;
    const at = event => {
      const zoom = canvas.width / canvas.clientWidth;
      return [event.offsetX * zoom, event.offsetY * zoom, zoom];
    };
    canvas.addEventListener('mousedown', event => { start = at(event); });
    window.addEventListener('mouseup', () => { start = null; });
    canvas.addEventListener('mousemove', event => {
      if (start === null) return;
      const [x, y, zoom] = at(event);
      draw();
      context.strokeStyle = '#e0302a';
      context.lineWidth = 2 * zoom;
      context.beginPath();
      context.moveTo(start[0], start[1]);
      context.lineTo(x, y);
      context.stroke();
      tell(Math.hypot(x - start[0], y - start[1]) * texel);
    });
  }

  const bytes = Uint8Array.from(atob(byId('textured_glb').textContent), c => c.charCodeAt(0));
  new THREE.GLTFLoader().parse(bytes.buffer, '', show, error => cannotDraw(place, error));
})();
