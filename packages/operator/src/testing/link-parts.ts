/** What a link is made of, for links of tests. */
export { type RobotChannel, RobotSession } from '../session/robot-session.ts';
export { type SessionActions, SessionKeeper } from '../session/session-keeper.ts';
