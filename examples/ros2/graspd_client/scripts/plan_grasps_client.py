#!/usr/bin/env python3
"""Asks graspd for grasps by its topics: ros2 run graspd_client plan_grasps_client.py mug.off parallel_85"""

import sys
import time
import uuid

import rclpy
from geometry_msgs.msg import Point
from graspd_msgs.msg import GraspRequest, RankedGrasps
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from shape_msgs.msg import Mesh, MeshTriangle

ATTEMPTS = 3
PATIENCE_S = 15.0  # graspd's default time budget is 10 s


def qos(durability):
    """The QoS of both topics: nothing may be dropped on the way."""
    return QoSProfile(reliability=ReliabilityPolicy.RELIABLE, durability=durability,
                      history=HistoryPolicy.KEEP_ALL)


def read_off(path):
    """The triangles of an OFF file, in metres."""
    with open(path, encoding='ascii') as file:
        words = file.read().split()
    if words[0] != 'OFF':
        raise ValueError(f'{path} is no OFF file')
    vertices, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    mesh = Mesh()
    for i in range(vertices):
        x, y, z = (float(word) for word in numbers[3 * i:3 * i + 3])
        mesh.vertices.append(Point(x=x, y=y, z=z))
    numbers = numbers[3 * vertices:]
    for i in range(faces):
        corners, *indices = (int(word) for word in numbers[4 * i:4 * i + 4])
        if corners != 3:
            raise ValueError(f'{path} has a face that is no triangle')
        mesh.triangles.append(MeshTriangle(vertex_indices=indices))
    return mesh


class PlanGraspsClient(Node):
    """Sends one request until its reply is there; the same id makes a second sending a retry."""

    def __init__(self):
        super().__init__('plan_grasps_client')
        self.client_id = f'python-{uuid.uuid4()}'[:64]
        self.reply = None
        self.publisher = self.create_publisher(
            GraspRequest, '/graspd/grasp_request', qos(DurabilityPolicy.VOLATILE))
        self.create_subscription(RankedGrasps, '/graspd/ranked_grasps', self.take,
                                 qos(DurabilityPolicy.TRANSIENT_LOCAL))

    def take(self, reply):
        if reply.client_id == self.client_id and self.reply is None:
            self.reply = reply

    def spin_until(self, condition, seconds):
        end = time.monotonic() + seconds
        while not condition() and time.monotonic() < end:
            rclpy.spin_once(self, timeout_sec=0.1)
        return condition()

    def is_matched(self):
        return (self.publisher.get_subscription_count() > 0
                and self.count_publishers('/graspd/ranked_grasps') > 0)

    def ask(self, path, gripper):
        request = GraspRequest(client_id=self.client_id, request_id='1', gripper=gripper,
                               mesh=read_off(path))
        request.header.frame_id = 'object'
        if not self.spin_until(self.is_matched, 10.0):
            raise RuntimeError('no planner within 10 s')
        for attempt in range(ATTEMPTS):
            self.reply = None
            self.publisher.publish(request)
            if (self.spin_until(lambda: self.reply is not None, PATIENCE_S)
                    and self.reply.status != RankedGrasps.STATUS_OVERLOADED):
                return self.reply
            time.sleep(0.5 * (attempt + 1))
        return self.reply


def show(reply):
    for grasp in reply.grasps:
        p, q = grasp.pose.position, grasp.pose.orientation
        print(f'score {grasp.score:.3f} at ({p.x:.4f} {p.y:.4f} {p.z:.4f}), '
              f'xyzw ({q.x:.3f} {q.y:.3f} {q.z:.3f} {q.w:.3f}), gap {grasp.width:.4f} m')
    if not reply.grasps:
        print(f'no grasp: {reply.message}', file=sys.stderr)
        for rejection in reply.report.rejections:
            print(f'  {rejection.reason}: {rejection.count}', file=sys.stderr)


def main():
    arguments = rclpy.utilities.remove_ros_args(sys.argv)
    if len(arguments) != 3:
        sys.exit('usage: plan_grasps_client.py FILE GRIPPER')
    rclpy.init()
    client = PlanGraspsClient()
    try:
        reply = client.ask(arguments[1], arguments[2])
    finally:
        client.destroy_node()
        rclpy.shutdown()
    if reply is None or reply.status == RankedGrasps.STATUS_OVERLOADED:
        sys.exit(4)
    show(reply)
    codes = {RankedGrasps.STATUS_NO_GRASP: 3, RankedGrasps.STATUS_PARTIAL: 3,
             RankedGrasps.STATUS_CANCELLED: 4, RankedGrasps.STATUS_INTERNAL_ERROR: 1}
    sys.exit(0 if reply.grasps else codes.get(reply.status, 2))  # as graspctl's


if __name__ == '__main__':
    main()
