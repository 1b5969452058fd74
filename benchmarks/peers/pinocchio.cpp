/* The articulated-body algorithm of Pinocchio on one body, its headers compiled here.
 *
 * k = m, centre of mass (3), central inertia (11 12 13 22 23 33), gravity (3), then for the free
 * body k, b (3), a (3).  Attitude as a quaternion; out come the accelerations alone.
 */
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody.hpp>

namespace pin = pinocchio;
using Vector3 = Eigen::Vector3d;
using In = Eigen::Map<const Eigen::VectorXd>;

struct Body {
    pin::Model model;
    pin::Data data;
    pin::container::aligned_vector<pin::Force> push;
    Eigen::VectorXd q, v, tau;
};
static Body *body;

extern "C" void pinocchio_setup(const double *k, int is_free)
{
    pin::Model model;
    const auto index = is_free
        ? model.addJoint(0, pin::JointModelFreeFlyer(), pin::SE3::Identity(), "joint")
        : model.addJoint(0, pin::JointModelSpherical(), pin::SE3::Identity(), "joint");
    Eigen::Matrix3d inertia;
    inertia << k[4], k[5], k[6], k[5], k[7], k[8], k[6], k[8], k[9];
    model.appendBodyToJoint(index, pin::Inertia(k[0], Vector3(k[1], k[2], k[3]), inertia));
    model.gravity.linear() << k[10], k[11], k[12];
    body = new Body{model, pin::Data(model), {}, {}, {}, {}};
    body->push.assign(2, pin::Force::Zero());
    body->q = Eigen::VectorXd::Zero(model.nq);
    body->v = body->tau = Eigen::VectorXd::Zero(model.nv);
}

/* x = quaternion (x y z w), angular velocity */
extern "C" void pinocchio_p1(const double *x, const double *, double *dx)
{
    body->q = In(x, 4);
    body->v = In(x + 4, 3);
    const auto &a = pin::aba(body->model, body->data, body->q, body->v, body->tau);
    Eigen::Map<Vector3>(dx, 3) = a;
}

/* x = T, quaternion (x y z w), velocity of the origin, angular velocity */
extern "C" void pinocchio_p2(const double *x, const double *k, double *dx)
{
    const Eigen::Map<const Eigen::Quaterniond> turn(x + 3);
    const Vector3 b(k[14], k[15], k[16]), a(k[17], k[18], k[19]), T(x[0], x[1], x[2]);
    const Vector3 force = -k[13] * (b + turn.toRotationMatrix().transpose() * (T - a));
    body->push[1] = pin::Force(force, b.cross(force));
    body->q = In(x, 7);
    body->v = In(x + 7, 6);
    const auto &found =
        pin::aba(body->model, body->data, body->q, body->v, body->tau, body->push);
    Eigen::Map<Vector3>(dx, 3) = found.tail<3>();
    Eigen::Map<Vector3>(dx + 3, 3) = found.head<3>();
}
