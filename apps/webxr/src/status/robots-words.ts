/** What the list of robots says besides their names. */

/** The chosen robot is none that is online. @param others how many robots are */
export function missingRobotWords(id: string, others: number): string {
  const choose = others === 0 ? '' : ' Or choose another.';
  return `No robot “${id}” is online: it is switched off, or its name in the address is wrong. This page connects as soon as it is there.${choose}`;
}
