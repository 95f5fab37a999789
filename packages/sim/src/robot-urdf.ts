/** The simulated robot's own description, in URDF: a round base on two wheels, a mast, its camera, and a LiDAR. */
import { DEFAULT_CAMERA } from './camera.ts';
import { DEFAULT_LIMITS } from './drive.ts';
import { DEFAULT_LIDAR } from './simulated-lidar.ts';

/** The wheels' joints, which turn as the wheels do. */
export const SIM_WHEEL_JOINTS = { left: 'left_wheel_joint', right: 'right_wheel_joint' } as const;

const { trackWidth, wheelRadius } = DEFAULT_LIMITS;
const WHEEL_WIDTH = 0.04;
/** The base is between the wheels, metres. */
const BASE_RADIUS = trackWidth / 2 - WHEEL_WIDTH / 2 - 0.005;
const MAST_X = 0.06;
const CAMERA = DEFAULT_CAMERA;

/** @param hasLidar whether one is on the mast */
export function simUrdf(hasLidar: boolean): string {
  const mastTop = hasLidar ? DEFAULT_LIDAR.up - 0.04 : CAMERA.up + 0.03;
  return `<?xml version="1.0"?>
<robot name="farpoint_sim">
  <material name="white"><color rgba="0.82 0.86 0.89 1"/></material>
  <material name="grey"><color rgba="0.5 0.56 0.62 1"/></material>
  <material name="dark"><color rgba="0.16 0.19 0.23 1"/></material>
  <material name="teal"><color rgba="0.21 0.79 0.71 1"/></material>
  <material name="amber"><color rgba="0.95 0.68 0.24 1"/></material>
  <link name="base_footprint"/>
  <joint name="base_joint" type="fixed">
    <parent link="base_footprint"/>
    <child link="base_link"/>
  </joint>
  <link name="base_link">
    ${visual('white', '0 0 0.14', cylinder(BASE_RADIUS, 0.12))}
    ${visual('grey', '0 0 0.21', cylinder(BASE_RADIUS - 0.02, 0.02))}
    ${visual('teal', `${BASE_RADIUS - 0.02} 0 0.15`, box(0.08, 0.12, 0.05))}
    ${visual('dark', `${0.04 - BASE_RADIUS} 0 0.04`, '<sphere radius="0.04"/>')}
    ${visual('dark', `${MAST_X} 0 ${(0.22 + mastTop) / 2}`, box(0.04, 0.04, mastTop - 0.22))}
    ${visual('white', `${CAMERA.forward - 0.03} 0 ${CAMERA.up}`, box(0.05, 0.16, 0.05))}
    ${hasLidar ? visual('dark', `${MAST_X} 0 ${DEFAULT_LIDAR.up}`, cylinder(0.05, 0.08)) : ''}
  </link>
${wheel('left', trackWidth / 2)}
${wheel('right', -trackWidth / 2)}
</robot>
`;
}

function wheel(side: keyof typeof SIM_WHEEL_JOINTS, y: number): string {
  const outside = Math.sign(y) * (WHEEL_WIDTH / 2);
  return `  <link name="${side}_wheel">
    ${visual('dark', '0 0 0', cylinder(wheelRadius, WHEEL_WIDTH), '1.5707963 0 0')}
    ${visual('amber', `${wheelRadius / 2} ${outside} 0`, box(wheelRadius * 0.7, 0.012, 0.03))}
  </link>
  <joint name="${SIM_WHEEL_JOINTS[side]}" type="continuous">
    <parent link="base_link"/>
    <child link="${side}_wheel"/>
    <origin xyz="0 ${y} ${wheelRadius}"/>
    <axis xyz="0 1 0"/>
  </joint>`;
}

function visual(material: string, xyz: string, geometry: string, rpy = '0 0 0'): string {
  const origin = `<origin xyz="${xyz}" rpy="${rpy}"/>`;
  return `<visual>${origin}<geometry>${geometry}</geometry><material name="${material}"/></visual>`;
}

function box(x: number, y: number, z: number): string {
  return `<box size="${x} ${y} ${z}"/>`;
}

function cylinder(cylinderRadius: number, length: number): string {
  return `<cylinder radius="${cylinderRadius}" length="${length}"/>`;
}
