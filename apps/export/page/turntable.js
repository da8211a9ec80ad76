// The front of a scene that has none of its own: towards -y where z is up.
function usualFront(up) {
  'use strict';
  return new THREE.Vector3(0, -1, 0).applyQuaternion(
      new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up));
}

// Shows a scene about the origin, to be turned with the mouse, at first from the front, a little to
// the right and above. Gives its camera, canvas and what draws it again.
function turntable(place, scene, up, radius, itsFront) {
  'use strict';
  const front = itsFront || usualFront(up);
  scene.background = new THREE.Color(0xeef1f4);
  const sky = new THREE.HemisphereLight(0xffffff, 0xa8a4a0, 0.8);
  sky.position.copy(up);
  scene.add(sky);
  const camera = new THREE.PerspectiveCamera(35, 1, radius / 100, radius * 100);
  const right = new THREE.Vector3().crossVectors(up, front);
  camera.up.copy(up);
  camera.position.copy(front).multiplyScalar(2.6).addScaledVector(right, 1.7)
      .addScaledVector(up, 1.6).multiplyScalar(radius);
  const sun = new THREE.DirectionalLight(0xffffff, 0.45);
  camera.add(sun);
  sun.position.set(-1, 1, 0.5);
  sun.target.position.set(0, 0, -1);
  camera.add(sun.target);
  scene.add(camera);

  const renderer = new THREE.WebGLRenderer({antialias: true});
  renderer.setPixelRatio(window.devicePixelRatio);
  place.append(renderer.domElement);
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  const render = () => renderer.render(scene, camera);
  const resize = () => {
    camera.aspect = place.clientWidth / place.clientHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(place.clientWidth, place.clientHeight);
    render();
  };
  controls.addEventListener('change', render);
  window.addEventListener('resize', resize);
  resize();
  controls.update();
  return {camera, canvas: renderer.domElement, render};
}

function cannotDraw(place, error) {  // most likely no WebGL
  'use strict';
  place.style.height = 'auto';
  place.textContent = 'The model cannot be drawn here: ' + error.message;
}
