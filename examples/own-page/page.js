import { CloudView, opticalYaw, RobotWorld } from '@farpoint/cloud-view';
import { connect } from '@farpoint/operator';
import { PerspectiveCamera, Scene, WebGLRenderer } from 'three';

const { signaling, robot: id, token } = Object.fromEntries(new URLSearchParams(location.search));
const robot = connect({ signaling, robot: id, token });
const renderer = new WebGLRenderer();
renderer.setSize(640, 360);
document.body.append(renderer.domElement);
const [scene, camera, world] = [new Scene(), new PerspectiveCamera(75, 640 / 360), new RobotWorld()];
const view = new CloudView(renderer, robot);
scene.add(world.add(view));
renderer.setAnimationLoop((nowMs) => {
  view.update(nowMs);
  camera.position.copy(view.cameraPosition).applyMatrix4(world.matrix);
  camera.rotation.y = opticalYaw(view.cameraOrientation, camera.rotation.y);
  renderer.render(scene, camera);
  view.noteDrawn();
});
// The robot moves while W is held. It stops when a request is not renewed within 200 ms.
const held = new Set();
addEventListener('keydown', ({ code }) => held.add(code));
addEventListener('keyup', ({ code }) => held.delete(code));
addEventListener('blur', () => held.clear());
setInterval(() => (held.has('KeyW') ? robot.drive({ forward: 1, left: 0 }) : robot.stop()), 50);
document.querySelector('#stop').addEventListener('pointerdown', () => robot.estop());
Object.assign(globalThis, { robot, view });
