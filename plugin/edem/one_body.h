// One body in substeps, without a solver around it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "edem/fragment_motion.h"
#include "edem/solver.h"

namespace rubble::edem {

/// One body without gravity and alone, driven stage by stage, for those who need its state in their own
/// hands: tests, and the testing machine. The order is that of Solver::tick; nothing is crushed.
template <class Real>
class OneBody {
 public:
  explicit OneBody(const BodyDef& def) {
    m_bodies.push_back(std::make_unique<Body<Real>>(makeBody<Real>(def, 0)));
  }
  Body<Real>& body() { return *m_bodies[0]; }
  const Books& books() const { return m_books; }
  const TickReport& report() const { return m_report; }

  void substep(double step, bool breaking) {
    Body<Real>& b = body();
    m_books.closeStep();
    beginSubstep(b.state, b.work);
    beginMotions(b);
    m_lists.build(m_bodies, 0.5 * double(b.constants->radius));
    m_books.elastic = accumulateSprings(b, b.work, step, breaking, m_books);
    for (PairList<Real>& l : m_lists.lists()) {
      accumulateContacts(l, b, b, {step, step}, m_resting, m_books);
      m_books.elastic += l.elastic;
    }
    applyBreaks(b, 0, step, m_lists, m_books, m_report);
    m_books.mass = m_books.kinetic = 0;
    m_books.linear.setZero();
    m_books.angular.setZero();
    using Points = std::span<const Vec3<double>>;
    integrate(b, step, step, Eigen::Vector3d::Zero(), Points(m_lists.grid(0).listed), Eigen::Vector3d::Zero(),
              m_books);
  }

 private:
  std::vector<std::unique_ptr<Body<Real>>> m_bodies;
  PairLists<Real> m_lists;
  RestingLoads m_resting;
  Books m_books;
  TickReport m_report;
};

}  // namespace rubble::edem
