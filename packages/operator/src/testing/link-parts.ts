/** What a link is made of, for links of tests. */
export { KeptLink } from '../link/kept-link.ts';
export type { RobotChannel } from '../session/robot-session.ts';
